#include "files/mesh/mesh_formats.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "files/sample_files.h"

namespace icome::files {
namespace {

using Parser = base::Result<ParsedMesh> (*)(std::string_view, const std::string&, io::TimeBudget*);

std::string error_of(Parser parse, std::string_view bytes) {
  const auto parsed = parse(bytes, "f", nullptr);
  return parsed ? "it was read" : parsed.error().message;
}

constexpr const char* kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
std::string obj_with(const std::string& lines) { return kThreeVertices + lines; }

TEST(ObjParser, FacesMayComeBeforeTheirVertices) {
  const auto parsed = parse_obj(std::string("f 1 2 3\n") + kThreeVertices, "f");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->mesh.triangles.size(), 1U);
}

TEST(ObjParser, EveryLineEndWorks) {
  for (const char* text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3\r\n", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3"}) {
    const auto parsed = parse_obj(text, "f");
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->mesh.triangles.size(), 1U);
  }
}

TEST(ObjParser, PolygonsAreCut) {
  const auto parsed = parse_obj(obj_with("v 1 1 0\nf 1 2 4 3\n"), "f");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->mesh.triangles.size(), 2U);
  EXPECT_DOUBLE_EQ(geometry::surface_area(parsed->mesh), 1.0);
}

TEST(ObjParser, BadLinesAreNamed) {
  EXPECT_EQ(error_of(parse_obj, obj_with("f 1 2 9\n")), "f:4: face refers to vertex 9 of 3");
  EXPECT_EQ(error_of(parse_obj, obj_with("f 1 2 -4\n")), "f:4: face refers to vertex -4 of 3");
  EXPECT_EQ(error_of(parse_obj, obj_with("f 0 1 2\n")),
            "f:4: face refers to vertex 0, but the first vertex is 1");
  EXPECT_EQ(error_of(parse_obj, obj_with("f 1 2 x\n")), "f:4: 'x' is not a vertex index");
  EXPECT_EQ(error_of(parse_obj, obj_with("f 1 2 2.5\n")), "f:4: '2.5' is not a vertex index");
  EXPECT_EQ(error_of(parse_obj, obj_with("f 1 2 99999999999999999999\n")),
            "f:4: '99999999999999999999' is not a vertex index");
  EXPECT_EQ(error_of(parse_obj, "v 0 0\nv 1 0 0\n"), "f:1: the line ends where a coordinate is expected");
  EXPECT_EQ(error_of(parse_obj, "v 0 0 0\n\nv 1,5 0 0\n"), "f:3: '1,5' is not a coordinate");
  EXPECT_EQ(error_of(parse_obj, "v 0 0"),
            "f:1: the file ends where a coordinate is expected: it may be cut short");
}

TEST(ObjParser, FaceOfTooManyCornersIsRefused) {
  std::string text = std::string(kThreeVertices) + "f";
  for (int i = 0; i < 20'001; ++i) text += " 1";
  EXPECT_EQ(error_of(parse_obj, text), "f:4: a face has 20001 corners; 20000 are the most that can be read");
}

TEST(OffParser, VariantsAreRead) {
  for (const char* text : {"OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                           "COFF\n3 1\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 9 9\n3 0 1 2\n",
                           "STCNOFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2 7"}) {
    const auto parsed = parse_off(text, "f");
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->mesh.positions[1], geometry::Vector3(1, 0, 0));
    EXPECT_EQ(parsed->mesh.triangles[0], (geometry::TriangleMesh::Triangle{0, 1, 2}));
  }
}

TEST(OffParser, BadLinesAreNamed) {
  EXPECT_EQ(error_of(parse_off, "OFF\n1 1 0\n0 0 0\n3 0 1 0\n"),
            "f:4: face refers to vertex 1; the 1 vertices are numbered from 0");
  EXPECT_EQ(error_of(parse_off, "OFF\n-1 1 0\n"), "f:2: -1 is not a number of vertices");
  EXPECT_EQ(error_of(parse_off, "OFF BINARY\n"), "f: is cut short");
  EXPECT_EQ(error_of(parse_off, "OFF\n4000000000000 4000000000000 0\n0 0 0\n"),
            "f:4: the file ends where a coordinate is expected: it may be cut short");
  EXPECT_EQ(error_of(parse_off, "OFF\n1 1 0\n0 0 0\n4000000000 0 0\n"),
            "f:4: the line ends where a vertex index is expected");
}

TEST(StlParser, SizeDecidesWhetherItIsBinary) {
  EXPECT_EQ(parse_stl(sample_binary_stl(), "f")->format, "binary STL");
  EXPECT_EQ(parse_stl(sample_ascii_stl(), "f")->format, "ascii STL");
}

TEST(PlyParser, WhatIsLeftOutIsToldByName) {
  const auto parsed = parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property uchar red\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nelement none 0\n"
      "property int nothing\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2 9\n0 1\n",
      "f");
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->notes,
            (std::vector<std::string>{"properties of vertices left out: s, t",
                                      "properties of faces left out: red", "elements left out: edge"}));
}

TEST(PlyParser, NamesOfWhatIsLeftOutGoOnWhereThereAreMore) {
  const auto told = [](int count) {
    std::string properties, numbers;
    for (int i = 0; i < count; ++i) {
      properties += "property float p" + std::to_string(i) + "\n";
      numbers += " 0";
    }
    const auto parsed = parse_ply(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
            properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
            numbers + "\n1 0 0" + numbers + "\n0 1 0" + numbers + "\n3 0 1 2\n",
        "f");
    if (!parsed) throw std::runtime_error(parsed.error().message);
    return parsed->notes.at(0);
  };
  const std::string twelve =
      "properties of vertices left out: p0, p1, p2, p3, p4, p5, p6, p7, p8, p9, p10, p11";
  EXPECT_EQ(told(12), twelve);
  EXPECT_EQ(told(13), twelve + " and so on");
  EXPECT_EQ(told(14), twelve + " and so on");
}

TEST(OffParser, WhatIsLeftOutIsTold) {
  const auto told = [](std::string_view text) { return parse_off(text, "f")->notes; };
  EXPECT_TRUE(told("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # a comment\n").empty());
  EXPECT_EQ(told("STCOFF\n3 1 0\n0 0 0 1 1 1 1 0 0\n1 0 0 1 1 1 1 0 0\n0 1 0 1 1 1 1 0 0\n3 0 1 2 255 0 0\n"),
            (std::vector<std::string>{"texture coordinates of vertices left out",
                                      "colours of vertices left out", "the colour of 1 face left out"}));
}

TEST(StlParser, TrianglesBeyondTheCountAreTold) {
  std::string bytes = sample_binary_stl();
  bytes[80] = 0;
  const auto parsed = parse_stl(bytes, "f");
  ASSERT_TRUE(parsed) << parsed.error().message;
  ASSERT_EQ(parsed->notes.size(), 1U);
  EXPECT_EQ(parsed->notes[0], "the bytes of 4 more triangles than the 0 that it declares left out");
}

TEST(StlParser, TruncatedFilesAreRefused) {
  const std::string binary = sample_binary_stl();
  EXPECT_EQ(error_of(parse_stl, binary.substr(0, binary.size() - 1)),
            "f: declares 4 triangles but holds 3: it is cut short or not an STL file");
  const std::string text = sample_ascii_stl();
  EXPECT_EQ(error_of(parse_stl, text.substr(0, text.find("endsolid"))),
            "f:29: the file ends without 'endsolid': it may be cut short");
  EXPECT_EQ(error_of(parse_stl, text.substr(0, text.find("endloop"))),
            "f:7: the file ends within a facet: it may be cut short");
}

TEST(StlParser, HugeCountInATinyFileIsRefused) {
  std::string bytes(80, '\0');
  bytes += bytes_of(std::uint32_t{0xffffffff}) + std::string(50, '\0');
  EXPECT_EQ(error_of(parse_stl, bytes),
            "f: declares 4294967295 triangles but holds 1: it is cut short or not an STL file");
}

TEST(PlyParser, BadHeadersAreNamed) {
  EXPECT_EQ(error_of(parse_ply, "ply\nformat ascii 1.0\nend_header\n"), "f: has no vertices");
  EXPECT_EQ(error_of(parse_ply, "ply\nend_header\n"), "f:2: the header has no format line");
  EXPECT_EQ(error_of(parse_ply, "ply\nformat xml 1.0\n"), "f:2: 'xml' is not a PLY format");
  EXPECT_EQ(error_of(parse_ply, "ply\nformat ascii 1.0\nproperty int x\n"),
            "f:3: the property belongs to no element");
  EXPECT_EQ(error_of(parse_ply, "ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n"),
            "f:4: 'half' is not a PLY number type");
  EXPECT_EQ(error_of(parse_ply, "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nend_header\n"),
            "f: the vertices have no coordinate y");
}

std::string ply_body(const std::string& counts_and_body,
                     const std::string& face = "uchar int vertex_indices") {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list " +
         face + "\nend_header\n" + counts_and_body;
}

TEST(PlyParser, BadRowsAreNamed) {
  EXPECT_EQ(error_of(parse_ply, ply_body("0 0 0 1 0 0 0 1 0\n3 0 1 3\n")),
            "f:11: face 1 refers to vertex 3; the 3 vertices are numbered from 0");
  EXPECT_EQ(error_of(parse_ply, ply_body("0 0 0 1 0 0 0 1 0\n3 0 1 -1\n")),
            "f:11: face 1 refers to vertex -1; the 3 vertices are numbered from 0");
  EXPECT_EQ(error_of(parse_ply, ply_body("0 0 0 1 0 0 0 1 0\n-3 0 1 2\n")),
            "f:11: a list has an impossible length");
  EXPECT_EQ(error_of(parse_ply, ply_body("0 0 0 1 0 zero 0 1 0\n")), "f:10: 'zero' is not a number");
  EXPECT_EQ(error_of(parse_ply, ply_body("", "uchar int corners")).substr(0, 2), "f:");
}

TEST(PlyParser, HugeCountsInATinyFileAreRefused) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string text = std::string("ply\nformat ") + format +
                             " 1.0\nelement nothing 9000000000000000000\nelement vertex 9000000000000000000\n"
                             "property float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
    EXPECT_NE(error_of(parse_ply, text).find("cut short"), std::string::npos);
  }
}

TEST(PlyParser, HostileIndicesAreRefused) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list double double vertex_indices\nelement vertex "
      "9000000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 0 1 "
      "8999999999999\n";
  EXPECT_NE(error_of(parse_ply, text).find("refers to vertex"), std::string::npos);
}

/// The sample with one piece of its JSON replaced by another of at most its length.
std::string glb_with(std::string_view old, std::string replacement) {
  std::string bytes = sample_glb();
  replacement.resize(old.size(), ' ');
  return bytes.replace(bytes.find(old), old.size(), replacement);
}
const std::string kGlbError = "f: is not a GLB file that can be read: ";

TEST(GlbParser, DataInOtherFilesMustBeBeside) {
  EXPECT_EQ(error_of(parse_glb, sample_glb("x")), kGlbError + "'x' is not fetched: there is no such file");
  EXPECT_NE(error_of(parse_glb, sample_glb("/etc/hosts")).find("not fetched"), std::string::npos);
}

TEST(GlbParser, StripsAndFansAreCut) {
  for (const char* mode : {"\"mode\":5 ", "\"mode\":6 "}) {
    const auto parsed = parse_glb(glb_with("\"indices\":1", mode), "f");
    ASSERT_TRUE(parsed) << parsed.error().message;
    // Four corners in a row give two triangles; the mirroring node turns both round.
    ASSERT_EQ(parsed->mesh.triangles.size(), 2U);
    EXPECT_EQ(parsed->mesh.triangles[0], (geometry::TriangleMesh::Triangle{0, 2, 1}));
    EXPECT_EQ(parsed->mesh.triangles[1][0], mode[7] == '5' ? 1U : 0U);
    EXPECT_EQ(parsed->mesh.triangles[1][1], mode[7] == '5' ? 2U : 3U);
  }
}

TEST(GlbParser, PlaceOfTheNodesIsKept) {
  const auto parsed = parse_glb(sample_glb(), "f");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->mesh.positions[1], geometry::Vector3(-2, 0, 5));
  EXPECT_EQ(parsed->mesh.positions[3], geometry::Vector3(0, 0, 7));
}

TEST(GlbParser, MalformedFilesAreRefused) {
  EXPECT_EQ(error_of(parse_glb, sample_glb().substr(0, sample_glb().size() - 1)),
            kGlbError + "it is cut short");
  EXPECT_EQ(error_of(parse_glb, glb_with("\"count\":12", "\"count\":13")),
            kGlbError + "an accessor reaches beyond its data");
  EXPECT_EQ(error_of(parse_glb, glb_with("\"children\":[1]", "\"children\":[0]")),
            kGlbError + "its nodes do not form a tree");
  EXPECT_EQ(error_of(parse_glb, glb_with("\"count\":4,", "\"count\":3,")),
            kGlbError + "face refers to vertex 3; the 3 vertices are numbered from 0");
  EXPECT_EQ(error_of(parse_glb, glb_with("\"nodes\":[{", "\"nodes\":[[")),
            kGlbError + "line 1 of its JSON is malformed");
}

TEST(PlyParser, TakesStripsOfTriangles) {
  // A square with z up of two triangles, another joined to it by repeated vertices, and one behind a -1.
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n3 0 0\n2 1 0\n3 1 0\n";
  const auto parsed = parse_ply(head + "14 0 1 2 3 3 4 4 5 6 7 -1 0 1 2\n", "f");
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->mesh.triangles.size(), 5U);
  double up = 0.0;
  for (std::size_t t = 0; t < parsed->mesh.triangles.size(); ++t) {
    const auto& a = parsed->mesh.corner(t, 0);
    up += 0.5 * (parsed->mesh.corner(t, 1) - a).cross(parsed->mesh.corner(t, 2) - a).z();
  }
  EXPECT_DOUBLE_EQ(up, 2.5) << "all run the same way round";
  EXPECT_EQ(error_of(parse_ply, head + "3 0 1 8\n"),
            "f:18: strip 1 refers to vertex 8; the 8 vertices are numbered from 0");
}

/// A square and a triangle with colours, as Geomview writes them in binary.
std::string binary_off(const std::string& keyword, std::size_t more) {
  std::string bytes = keyword + " BINARY\n";
  for (const std::uint32_t count : {4U, 2U, 0U}) bytes += bytes_of(count, true);
  for (const auto& [x, y] : {std::pair(0.0F, 0.0F), {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
    for (const float part : {x, y, 0.0F}) bytes += bytes_of(part, true);
    for (std::size_t i = 0; i < more; ++i) bytes += bytes_of(0.5F, true);
  }
  for (const std::uint32_t number : {4U, 0U, 1U, 2U, 3U, 0U, 3U, 0U, 1U, 2U, 3U})
    bytes += bytes_of(number, true);
  for (int i = 0; i < 3; ++i) bytes += bytes_of(0.25F, true);
  return bytes;
}

TEST(OffParser, TakesBinaryFiles) {
  for (const auto& [keyword, more] : {std::pair("OFF", 0), {"COFF", 4}, {"NOFF", 3}, {"STCNOFF", 9}}) {
    const std::string bytes = binary_off(keyword, std::size_t(more));
    const auto parsed = parse_off(bytes, "f");
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->format, "binary OFF");
    EXPECT_EQ(parsed->mesh.triangles.size(), 3U) << keyword;
    EXPECT_DOUBLE_EQ(geometry::surface_area(parsed->mesh), 1.5) << keyword;
    for (std::size_t cut = std::string(keyword).size() + 8; cut < bytes.size(); ++cut)
      EXPECT_EQ(error_of(parse_off, bytes.substr(0, cut)), "f: is cut short") << cut;
  }
  std::string far = binary_off("OFF", 0);
  far[far.size() - 17] = 9;  // the last corner
  EXPECT_EQ(error_of(parse_off, far), "f: face refers to vertex 9; the 4 vertices are numbered from 0");
}

}  // namespace
}  // namespace icome::files

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "animation/export/export_animation.h"
#include "animation/picture/small_project.h"
#include "base/clock.h"
#include "base/parse_number.h"
#include "own_folder.h"
#include "sound/wav_file.h"

namespace icome::animation {
namespace {

namespace fs = std::filesystem;

/// The standard output of a command line, which must succeed.
std::string output_of(const std::string& command) {
  std::string bytes;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error(command);
  std::array<char, 65536> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe))
    bytes.append(block.data(), count);
  if (::pclose(pipe) != 0) throw std::runtime_error(command + " failed");
  return bytes;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Frames of a film as ffmpeg decodes them, red, green, blue, opacity.
std::vector<charts::Image> decoded(const fs::path& file, int width, int height,
                                   const std::string& decoder = "") {
  const std::string bytes = output_of(fmt::format(
      "ffmpeg -v error {} -i '{}' -vsync passthrough -f rawvideo -pix_fmt rgba -", decoder, file.string()));
  const std::size_t size = std::size_t(4) * std::size_t(width) * std::size_t(height);
  EXPECT_EQ(bytes.size() % size, 0U);
  std::vector<charts::Image> frames;
  for (std::size_t at = 0; at + size <= bytes.size(); at += size)
    frames.push_back(
        {width, height, {bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + size)}});
  return frames;
}

std::string probed(const fs::path& file, const std::string& stream, const std::string& entry) {
  std::string text = output_of(fmt::format(
      "ffprobe -v error -count_frames -select_streams {} -show_entries {} -of default=nw=1:nk=1 '{}'", stream,
      entry, file.string()));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

double number_in(const std::string& text) { return base::number_at_front<double>(text).value; }

/// Peak signal to noise, dB, of red, green and blue over a white ground.
double psnr(const charts::Image& one, const charts::Image& other) {
  double sum = 0;
  const std::size_t pixels = one.rgba.size() / 4;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto seen = [&](const charts::Image& image) {
        const double alpha = image.rgba[4 * i + 3] / 255.0;
        return alpha * image.rgba[4 * i + c] + 255 * (1 - alpha);
      };
      sum += std::pow(seen(one) - seen(other), 2);
    }
  return 10 * std::log10(255.0 * 255.0 * 3 * double(pixels) / std::max(sum, 1e-9));
}

class Export : public testing::Test {
 protected:
  Export() {
    Pixels square(40, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        square.row(y)[x] = x < 20 && y < 20 ? premultiplied(250, 200, 0, 255)
                                            : premultiplied(30, unsigned(3 * x), 160, x > 30 ? 128 : 255);
    folder_.write_png("square.png", square);
    folder_.write("disc.svg",
                  "<svg xmlns='http://www.w3.org/2000/svg' width='30' height='30'>"
                  "<circle cx='15' cy='15' r='14' fill='#284' stroke='#000' stroke-width='2'/></svg>");
    project_.stage.length = 12;
    project_.stage.background = {0.9F, 0.95F, 1.0F};
    Cell& square_cell = add_cell(project_, "square.png", {20, 20}, {30, 40});
    square_cell.tracks[std::size_t(Channel::X)] = {{0, 20.0}, {11, 80.0}};
    square_cell.tracks[std::size_t(Channel::Angle)] = {{0, 0.0}, {11, 1.5}};
    Cell& disc = add_cell(project_, "disc.svg", {15, 15}, {60, 30});
    disc.rest.scale = 1.5;
    disc.rest.opacity = 0.8;
  }

  CellStates states(int frame) const { return states_by_keys(project_, frame); }
  base::Result<ExportReport> write(const std::string& name, const ExportOptions& options = {}) {
    return export_animation(
        project_, [this](int frame) { return states(frame); }, pictures_, (folder_ / name).string(), options);
  }
  charts::Image drawn(int frame, bool background = true) {
    FrameOptions options;
    options.backdrop = background ? Backdrop::Everywhere : Backdrop::None;
    return image_of(draw_frame(project_, states(frame), pictures_, options));
  }
  /// Names below the folder that no picture of the project has.
  std::vector<std::string> others() const {
    std::vector<std::string> names;
    for (const auto& each : fs::recursive_directory_iterator(folder_.path()))
      if (each.path().filename() != "square.png" && each.path().filename() != "disc.svg")
        names.push_back(fs::relative(each.path(), folder_.path()).string());
    std::ranges::sort(names);
    return names;
  }

  TestFolder folder_{own_folder("export")};
  Project project_ = small_project(120, 80);
  CellPictures pictures_{folder_.path()};
};

TEST_F(Export, PngSequencesAreTheFramesAsDrawn) {
  folder_.write("frame0003.png", "old");
  folder_.write("frame0099.png", "of another");
  const auto report = write("", {.range = FrameRange{2, 4}});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->frames, 3);
  EXPECT_EQ(report->width, 120);
  EXPECT_TRUE(report->remarks.empty());
  EXPECT_EQ(others(),
            (std::vector<std::string>{"frame0002.png", "frame0003.png", "frame0004.png", "frame0099.png"}));
  for (int frame = 2; frame <= 4; ++frame) {
    const auto read = pictures_.raster(fmt::format("frame000{}.png", frame), 1);
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)->pixels.words, draw_frame(project_, states(frame), pictures_).words);
  }
  EXPECT_EQ(bytes_of(folder_ / "frame0099.png"), "of another");
}

TEST_F(Export, PngKeepsWhatIsClear) {
  ASSERT_TRUE(write("one.png", {.range = FrameRange{5, 5}, .background = false}));
  FrameOptions clear;
  clear.backdrop = Backdrop::None;
  const Pixels expected = draw_frame(project_, states(5), pictures_, clear);
  const RasterPointer read = pictures_.raster("one.png", 1).value();
  EXPECT_EQ(read->pixels.words[0], 0U);
  for (std::size_t i = 0; i < expected.words.size(); ++i)
    for (unsigned c = 0; c < 4; ++c)
      EXPECT_NEAR(int(read->pixels.words[i] >> (8 * c) & 0xffU), int(expected.words[i] >> (8 * c) & 0xffU),
                  1);
}

TEST_F(Export, SvgFramesLookAsThoseOfPixels) {
  project_.camera.rest.scale = 1.3;
  project_.camera.rest.angle = 0.2;
  add_cell(project_, "gone.png", {64, 64}, {100, 10}).rest.scale = 0.3;
  const auto report = write("svg/shot%02d.svg");
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->files.size(), 12U);
  EXPECT_EQ(report->remarks, std::vector<std::string>{
                                 "A crossed frame is shown for a picture: gone.png: there is no such file."});
  for (const int frame : {0, 7}) {
    const std::string text = bytes_of(folder_ / fmt::format("svg/shot{:02}.svg", frame));
    const auto svg = SvgPicture::read(text, "shot.svg", 10);
    ASSERT_TRUE(svg) << svg.error().message;
    const Pixels rendered = svg->drawn(120, 80, 10).value();
    EXPECT_GT(psnr(image_of(rendered), drawn(frame)), 28) << frame;
    // Each picture is in it once.
    std::size_t count = 0;
    for (std::size_t at = text.find("<image"); at != std::string::npos; at = text.find("<image", at + 1))
      ++count;
    EXPECT_EQ(count, 2U);
  }
}

TEST_F(Export, SequencesAreTheSameBytesEachTime) {
  for (const std::string ending : {"png", "svg"}) {
    ASSERT_TRUE(write("a/%d." + ending));
    pictures_ = CellPictures(folder_.path());
    ASSERT_TRUE(write("b/%d." + ending));
    for (int i = 0; i < 12; ++i)
      EXPECT_EQ(bytes_of(folder_ / fmt::format("a/{}.{}", i, ending)),
                bytes_of(folder_ / fmt::format("b/{}.{}", i, ending)));
  }
}

TEST_F(Export, AStopLeavesThingsAsTheyWere) {
  folder_.write("f3.png", "old");
  for (const std::string name : {"f%d.png", "new/f%d.png", "f%d.svg"}) {
    int asked = 0;
    ExportOptions options;
    options.progress = [&](double part) {
      EXPECT_GE(part, 0);
      EXPECT_LE(part, 1);
      return ++asked < 7;
    };
    const auto report = write(name, options);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "the export was stopped before its end, and nothing of it is kept");
    EXPECT_EQ(others(), std::vector<std::string>{"f3.png"});
  }
  EXPECT_EQ(bytes_of(folder_ / "f3.png"), "old");
}

TEST_F(Export, TellsWhatCannotBeDone) {
  const auto fault = [&](const std::string& name, const ExportOptions& options) {
    const auto report = write(name, options);
    return report ? "" : report.error().message;
  };
  EXPECT_EQ(fault("a%d.png", {.range = FrameRange{3, 12}}),
            "frames 3 to 12 cannot be written: there are those from 0 to 11");
  EXPECT_NE(fault("a%d.png", {.range = FrameRange{5, 4}}), "");
  EXPECT_EQ(fault("a%d.png", {.width = 9000}),
            "a picture of 9000 x 0 px cannot be written; sides go from 2 to 8192");
  fs::create_directory(folder_ / "a3.png");
  EXPECT_NE(fault("a%d.png", {}).find("a3.png: cannot be written"), std::string::npos);
  folder_.write("file", "");
  EXPECT_NE(fault("file/a%d.png", {}).find("cannot be written"), std::string::npos);
  EXPECT_NE(fault("file/a.mp4", {}).find("cannot be written"), std::string::npos);
  EXPECT_NE(fault("there/is/no/such/folder.mp4", {}).find("cannot be written"), std::string::npos);
}

/// With ffmpeg, or one that stands in for it.
class Film : public Export {
 protected:
  void SetUp() override {
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "ffmpeg is not there; apt install ffmpeg";
  }
  void TearDown() override {
    if (path_) ::setenv("PATH", path_->c_str(), 1);
  }
  /// From here on, the programs are those of the folder alone.
  void use_programs_of(const fs::path& folder) {
    path_ = std::getenv("PATH");
    ::setenv("PATH", folder.c_str(), 1);
  }
  void use_instead_of_ffmpeg(const std::string& script) {
    fs::create_directory(folder_ / "bin");
    folder_.write("bin/ffmpeg", "#!/bin/sh\nPATH=/usr/bin:/bin\n" + script);
    fs::permissions(folder_ / "bin/ffmpeg", fs::perms::owner_all);
    use_programs_of(folder_ / "bin");
  }
  void add_sound(double start) {
    write_wav(folder_ / "tone.wav", 22050, 1, sine(22050, 1000, 2, 0.5));
    project_.sound = Sound{"tone.wav", start, 1};
  }

  std::optional<std::string> path_;
};

struct FilmKind {
  const char* name;
  double least_psnr;
};

class FilmOf : public Film, public testing::WithParamInterface<FilmKind> {};

TEST_P(FilmOf, HasTheFramesAtTheirRateAndTheSameBytesEachTime) {
  const std::string name = GetParam().name;
  add_sound(0);
  project_.stage.length = 25;
  const auto report = write(name);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->frames, 25);
  EXPECT_EQ(report->seconds, 1);
  EXPECT_EQ(report->files, std::vector<std::string>{(folder_ / name).string()});
  EXPECT_EQ(probed(folder_ / name, "v:0", "stream=nb_read_frames"), "25");
  EXPECT_EQ(probed(folder_ / name, "v:0", "stream=r_frame_rate"), "25/1");
  EXPECT_EQ(probed(folder_ / name, "v:0", "stream=width,height"), "120\n80");
  const std::vector<charts::Image> frames = decoded(folder_ / name, 120, 80);
  ASSERT_EQ(frames.size(), 25U);
  for (int i = 0; i < 25; ++i) EXPECT_GT(psnr(frames[std::size_t(i)], drawn(i)), GetParam().least_psnr) << i;

  pictures_ = CellPictures(folder_.path());
  ASSERT_TRUE(write(std::string("again-") + name));
  EXPECT_TRUE(bytes_of(folder_ / name) == bytes_of(folder_ / (std::string("again-") + name)));
}

INSTANTIATE_TEST_SUITE_P(Each, FilmOf,
                         testing::Values(FilmKind{"film.mp4", 30}, FilmKind{"film.webm", 30},
                                         FilmKind{"film.gif", 28}, FilmKind{"film.apng", 90}),
                         [](const auto& kind) { return std::string(kind.param.name).substr(5); });

TEST_F(Film, KeepsWhatIsClear) {
  for (const auto& [name, decoder] :
       {std::pair("film.apng", ""), std::pair("film.webm", "-c:v libvpx-vp9"), std::pair("film.gif", "")}) {
    const auto report = write(name, {.background = false});
    ASSERT_TRUE(report) << report.error().message;
    const std::vector<charts::Image> frames = decoded(folder_ / name, 120, 80, decoder);
    ASSERT_EQ(frames.size(), 12U) << name;
    for (int i = 0; i < 12; ++i) {
      const charts::Image expected = drawn(i, false);
      const charts::Image& frame = frames[std::size_t(i)];
      EXPECT_LT(frame.pixel(2, 2)[3], 3) << name;      // nothing is there
      EXPECT_GT(frame.pixel(60, 30)[3], 190) << name;  // the disc
      if (std::string(name) == "film.apng") {
        EXPECT_GT(psnr(frame, expected), 60);
      } else if (std::string(name) == "film.webm") {
        EXPECT_GT(psnr(frame, expected), 27);
      }
    }
  }
  const auto report = write("film.mp4", {.background = false});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->remarks,
            std::vector<std::string>{"MP4 knows nothing clear, so the background is shown."});
  EXPECT_GT(psnr(decoded(folder_ / "film.mp4", 120, 80)[3], drawn(3)), 30);
}

TEST_F(Film, HasItsSoundFromWhereItBegins) {
  project_.stage.length = 50;
  add_sound(0.5);
  for (const std::string name : {"film.mp4", "film.webm"}) {
    const auto report = write(name, {.range = FrameRange{5, 44}});  // 0.2 s to 1.8 s: it begins after 0.3 s
    ASSERT_TRUE(report) << report.error().message;
    const std::string bytes = output_of(
        fmt::format("ffmpeg -v error -i '{}' -f s16le -ar 48000 -ac 1 -", (folder_ / name).string()));
    std::vector<double> values(bytes.size() / 2);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = double(std::int16_t(std::uint16_t(static_cast<unsigned char>(bytes[2 * i])) |
                                      std::uint16_t(static_cast<unsigned char>(bytes[2 * i + 1]) << 8U))) /
                  32767;
    EXPECT_NEAR(double(values.size()) / 48000, 1.6, 0.05) << name;
    const auto strength = [&](double from, double to) {
      double sum = 0;
      const auto first = std::size_t(from * 48000), last = std::size_t(to * 48000);
      for (std::size_t i = first; i < last; ++i) sum += values.at(i) * values.at(i);
      return std::sqrt(sum / double(last - first));
    };
    EXPECT_LT(strength(0.0, 0.27), 0.02) << name;
    EXPECT_NEAR(strength(0.35, 1.5), 0.5 / std::numbers::sqrt2, 0.03) << name;
    EXPECT_NEAR(number_in(probed(folder_ / name, "v:0", "format=duration")), 1.6, 0.05);
  }
}

TEST_F(Film, TellsOfSoundThatIsMissingOrLeftOut) {
  project_.sound = Sound{"gone.ogg", 0, 1};
  const auto silent = write("film.mp4");
  ASSERT_TRUE(silent) << silent.error().message;
  EXPECT_EQ(silent->remarks,
            std::vector<std::string>{"The film is silent: gone.ogg: there is no such file."});
  EXPECT_FALSE(silent->is_whole);
  EXPECT_TRUE(write("film.mp4", {.sound = false}).value().is_whole);
  add_sound(0);
  EXPECT_EQ(write("film.gif").value().remarks,
            std::vector<std::string>{"GIF has no sound, so it is left out."});
}

TEST_F(Film, MakesSidesEven) {
  project_.stage.width = 121;
  project_.stage.height = 81;
  const auto report = write("film.mp4");
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->width, 122);
  EXPECT_EQ(report->height, 82);
  ASSERT_EQ(report->remarks.size(), 1U);
  const charts::Image frame = decoded(folder_ / "film.mp4", 122, 82)[4];
  EXPECT_NEAR(frame.pixel(121, 81)[0], 230, 8);  // the background goes on
  // Formats without that limit keep their sides.
  EXPECT_EQ(write("film.apng").value().width, 121);
  EXPECT_EQ(probed(folder_ / "film.apng", "v:0", "stream=width,height"), "121\n81");
}

TEST_F(Film, KnowsRatesThatAreNoWholeNumbers) {
  project_.stage.rate = 24000.0 / 1001;
  ASSERT_TRUE(write("film.mp4"));
  EXPECT_EQ(probed(folder_ / "film.mp4", "v:0", "stream=r_frame_rate"), "24000/1001");
  project_.stage.rate = 30;
  const auto report = write("film.gif");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->remarks.size(), 1U);
  EXPECT_NEAR(number_in(probed(folder_ / "film.gif", "v:0", "format=duration")), 0.4, 0.021);
}

TEST_F(Film, OfOneFrameIsWritten) {
  for (const std::string name : {"film.mp4", "film.webm", "film.gif", "film.apng"}) {
    const auto report = write(name, {.range = FrameRange{4, 4}});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(decoded(folder_ / name, 120, 80).size(), 1U);
  }
}

TEST_F(Film, SaysWhatToInstallWithoutFfmpeg) {
  fs::create_directory(folder_ / "empty");
  use_programs_of(folder_ / "empty");
  folder_.write("film.mp4", "old");
  const auto report = write("film.mp4");
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message,
            "films are written by the program ffmpeg, which is not there; install it (apt install ffmpeg), "
            "or write "
            "pictures: --out frames/");
  EXPECT_EQ(bytes_of(folder_ / "film.mp4"), "old");
  EXPECT_EQ(others(), (std::vector<std::string>{"empty", "film.mp4"}));
}

TEST_F(Film, RepeatsWhatFfmpegComplainsAbout) {
  use_instead_of_ffmpeg("head -c 100 > /dev/null; echo 'Unknown encoder libx264' >&2; exit 1\n");
  folder_.write("film.mp4", "old");
  EXPECT_EQ(write("film.mp4").error().message, "ffmpeg has failed: Unknown encoder libx264");
  EXPECT_EQ(bytes_of(folder_ / "film.mp4"), "old");
  EXPECT_EQ(others(), (std::vector<std::string>{"bin", "bin/ffmpeg", "film.mp4"}));
}

TEST_F(Film, NoticesAnFfmpegThatEndsEarly) {
  project_.stage.length = 200;
  use_instead_of_ffmpeg("exit 0\n");
  EXPECT_EQ(write("film.mp4").error().message, "ffmpeg has failed: it ended before the last frame");
}

TEST_F(Film, AnFfmpegThatWritesMuchIsHeardToItsEnd) {
  use_instead_of_ffmpeg("head -c 500000 /dev/zero | tr '\\0' 'x' >&2; cat > /dev/null; exit 3\n");
  const std::string message = write("film.mp4").error().message;
  EXPECT_LT(message.size(), 9000U);
  EXPECT_TRUE(message.starts_with("ffmpeg has failed: xxx"));
}

TEST_F(Film, AStopEndsAnFfmpegThatHangs) {
  project_.stage.length = 300;
  use_instead_of_ffmpeg("echo $$ > \"$(dirname \"$0\")/pid\"; exec sleep 1000\n");
  const auto began = base::steady_nanoseconds();
  ExportOptions options;
  options.progress = [&](double) { return double(base::steady_nanoseconds() - began) < 0.5e9; };
  const auto report = write("film.webm", options);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "the export was stopped before its end, and nothing of it is kept");
  EXPECT_LT(double(base::steady_nanoseconds() - began), 5e9);
  const auto process = pid_t(number_in(bytes_of(folder_ / "bin/pid")));
  ASSERT_GT(process, 0);
  EXPECT_NE(::kill(process, 0), 0);
  EXPECT_EQ(others(), (std::vector<std::string>{"bin", "bin/ffmpeg", "bin/pid"}));
}

}  // namespace
}  // namespace icome::animation

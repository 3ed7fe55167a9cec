#include "render/csg/csg_view.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <opencsg.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"

// Declared here, because the headers of GLEW and epoxy exclude each other.
extern "C" unsigned glewInit();  // NOLINT(readability-identifier-naming): theirs

namespace icome::render {
namespace {

/// OpenCSG and GLEW keep their state in global variables.
struct Library {
  std::mutex lock;
  int last_number = 0;  // given to a context; none twice
  int loaded_for = 0;   // the context whose functions GLEW found last
};

Library& library() {
  static Library it;
  return it;
}

/// Finds the OpenGL functions that OpenCSG calls: version 1.5 takes them from GLEW, for the context that is
/// current. False when GLEW does not know the context.
bool load_library_functions() {
  constexpr unsigned kGood = 0;
  constexpr unsigned kNoWindowSystem = 4;  // functions for X windows are missing; OpenGL itself is loaded
  const unsigned outcome = glewInit();
  return outcome == kGood || outcome == kNoWindowSystem;
}

template <typename T>
void fill_buffer(GLenum target, const GlObject& buffer, const std::vector<T>& data) {
  glBindBuffer(target, buffer.name());
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
}

/// An operand's buffers, as the built-in inputs of a compatibility context.
class OperandView {
 public:
  explicit OperandView(const CsgOperand& operand)
      : bounds(operand.bounds),
        layers(operand.layers),
        faces{operand.colour, operand.subtracted},
        count_(static_cast<GLsizei>(operand.mesh.indices.size())) {
    using Vertex = ShadingMesh::Vertex;
    glBindVertexArray(arrays_.name());
    fill_buffer(GL_ARRAY_BUFFER, vertices_, operand.mesh.vertices);
    fill_buffer(GL_ELEMENT_ARRAY_BUFFER, indices_, operand.mesh.indices);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof(Vertex), reinterpret_cast<const void*>(offsetof(Vertex, position)));
    glNormalPointer(GL_FLOAT, sizeof(Vertex), reinterpret_cast<const void*>(offsetof(Vertex, normal)));
    glBindVertexArray(0);
  }

  void draw() const {
    glBindVertexArray(arrays_.name());
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
  }

  base::Bounds bounds;
  std::optional<unsigned> layers;
  CsgFaces faces;

 private:
  GlObject arrays_{GlObject::Kind::VertexArray};
  GlObject vertices_{GlObject::Kind::Buffer};
  GlObject indices_{GlObject::Kind::Buffer};
  GLsizei count_;
};

using ProductView = std::vector<OperandView>;

/// Largest number of the operand's fronts that lie one behind the other, in the view that is set.
unsigned count_layers(const OperandView& operand) {
  std::array<GLint, 4> port{};
  glGetIntegerv(GL_VIEWPORT, port.data());
  glPushAttrib(GL_ENABLE_BIT | GL_STENCIL_BUFFER_BIT | GL_COLOR_BUFFER_BIT | GL_POLYGON_BIT);
  glClearStencil(0);
  glStencilMask(0xff);
  glClear(GL_STENCIL_BUFFER_BIT);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 0, 0xff);
  glStencilOp(GL_INCR, GL_INCR, GL_INCR);
  operand.draw();
  glPopAttrib();
  std::vector<GLubyte> counts(static_cast<std::size_t>(port[2]) * static_cast<std::size_t>(port[3]));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(port[0], port[1], port[2], port[3], GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, counts.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  return std::max<unsigned>(1, *std::max_element(counts.begin(), counts.end()));
}

class LibraryPrimitive final : public OpenCSG::Primitive {
 public:
  LibraryPrimitive(const OperandView& operand, const Matrix4& clip_from_buffer)
      : Primitive(operand.faces.subtracted ? OpenCSG::Subtraction : OpenCSG::Intersection,
                  operand.layers ? *operand.layers : count_layers(operand)),
        operand_(operand) {
    const base::Bounds box = device_box(operand.bounds, clip_from_buffer);
    const Eigen::Vector3f low = box.min().cast<float>();
    const Eigen::Vector3f high = box.max().cast<float>();
    setBoundingBox(low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  }

  void render() override { operand_.draw(); }

 private:
  const OperandView& operand_;
};

/// Chooses as OpenCSG would by itself, but asks sooner whether a further round of subtractions
/// changes anything: that pays from few operands on where the processor does the drawing.
void set_algorithm(const std::vector<LibraryPrimitive>& operands) {
  constexpr std::ptrdiff_t kRoundsWorthAQuery = 4;
  const auto subtracted = std::count_if(operands.begin(), operands.end(), [](const auto& operand) {
    return operand.getOperation() == OpenCSG::Subtraction;
  });
  const bool convex = std::all_of(operands.begin(), operands.end(),
                                  [](const auto& operand) { return operand.getConvexity() == 1; });
  const bool ask = convex && subtracted > kRoundsWorthAQuery;
  OpenCSG::setOption(OpenCSG::AlgorithmSetting, convex ? OpenCSG::SCS : OpenCSG::Goldfeather);
  OpenCSG::setOption(OpenCSG::DepthComplexitySetting,
                     ask ? OpenCSG::OcclusionQuery : OpenCSG::NoDepthComplexitySampling);
}

void draw_product_depth(const ProductView& product, const Matrix4& clip_from_buffer) {
  std::vector<LibraryPrimitive> operands;
  operands.reserve(product.size());
  for (const OperandView& operand : product) operands.emplace_back(operand, clip_from_buffer);
  std::vector<OpenCSG::Primitive*> pointers;
  for (LibraryPrimitive& operand : operands) pointers.push_back(&operand);
  set_algorithm(operands);
  OpenCSG::render(pointers);
}

/// One closed mesh hides itself: no images are needed to find its visible surface.
void draw_lone_depth(const OperandView& operand) {
  glPushAttrib(GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT | GL_POLYGON_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  operand.draw();
  glPopAttrib();
}

void set_matrix(const Matrix4& clip_from_buffer) {
  const Eigen::Matrix4f model = clip_from_buffer.cast<float>();
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixf(model.data());
}

}  // namespace

base::Result<std::shared_ptr<CsgImages>> CsgImages::create() {
  Library& lib = library();
  const std::lock_guard hold(lib.lock);
  const ContextTraits traits = context_traits();
  if (!traits.built_in_pipeline || !load_library_functions()) {
    return base::fail(fmt::format("{} offers no OpenGL 3.3 compatibility context, which images of CSG need",
                                  traits.renderer));
  }
  lib.loaded_for = ++lib.last_number;
  return std::shared_ptr<CsgImages>(new CsgImages(lib.last_number));
}

CsgImages::~CsgImages() {
  const auto turn = take_turn();
  OpenCSG::freeResources();
}

std::unique_lock<std::mutex> CsgImages::take_turn() const {
  Library& lib = library();
  std::unique_lock turn(lib.lock);
  // Another context's driver may have other functions.
  if (lib.loaded_for != number_) load_library_functions();
  lib.loaded_for = number_;
  OpenCSG::setContext(number_);
  return turn;
}

struct CsgView::Solid {
  std::shared_ptr<const CsgImages> images;
  std::vector<ProductView> products = {};
};

CsgView::CsgView(std::shared_ptr<const CsgImages> images, const CsgGeometry& geometry)
    : solid_(std::make_unique<Solid>()), tree_from_buffer_(geometry.tree_from_buffer()) {
  solid_->images = std::move(images);
  for (const CsgOperands& product : geometry.products) {
    ProductView& view = solid_->products.emplace_back();
    for (const CsgOperand& operand : product) view.emplace_back(operand);
  }
}

CsgView::CsgView(CsgView&&) noexcept = default;
CsgView& CsgView::operator=(CsgView&&) noexcept = default;
CsgView::~CsgView() = default;

void CsgView::draw_depth(const Matrix4& clip_from_buffer) const {
  glUseProgram(0);
  set_matrix(clip_from_buffer);
  glBindBuffer(GL_ARRAY_BUFFER, 0);  // OpenCSG has arrays outside of buffers
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glEnable(GL_DEPTH_TEST);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  {
    const auto turn = solid_->images->take_turn();
    for (const ProductView& product : solid_->products) {
      if (product.size() == 1) {
        draw_lone_depth(product.front());
      } else {
        draw_product_depth(product, clip_from_buffer);
      }
    }
  }
  glPopAttrib();
}

void CsgView::shade(const Matrix4& clip_from_buffer,
                    const std::function<void(const CsgFaces&)>& prepare) const {
  set_matrix(clip_from_buffer);
  glPushAttrib(GL_ENABLE_BIT | GL_POLYGON_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  for (const ProductView& product : solid_->products) {
    for (const OperandView& operand : product) {
      prepare(operand.faces);
      glCullFace(operand.faces.subtracted ? GL_FRONT : GL_BACK);
      operand.draw();
    }
  }
  glPopAttrib();
}

}  // namespace icome::render

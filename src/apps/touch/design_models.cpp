#include "apps/touch/design_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/stopwatch.h"
#include "apps/touch/design_eyes.h"
#include "apps/touch/design_motions.h"
#include "apps/touch/exact_models.h"
#include "files/design_files.h"
#include "haptics/judge/plain_solid.h"
#include "session/felt/haptic_representation.h"
#include "session/felt/stretched.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::apps {
namespace {

using base::Affine3;
using world::World;

constexpr std::size_t kMostSentences = 20;  // of a design's; `icome info` lists them all

base::Result<files::LoadedDesign> read_file(const std::string& text, const TouchOptions& options) {
  if (is_remote(text)) {
    StatusLine status;
    return fetch_design(text, status);
  }
  auto how = understood_reading(options.reading);
  if (!how) return tl::unexpected(how.error());
  how->with_looks = false;
  how->progress = [](double) { return !interrupted(); };
  return files::read_design(text, *how);
}

/// The placing of a design: scaled about the origin, never moved, as all MODELs are.
Affine3 placing(const World& world, const TouchOptions& options) {
  Affine3 world_from_design = Affine3::Identity();
  if (!options.fit) return world_from_design;
  const double longest = longest_side(world);
  if (longest > 0.0) world_from_design.linear() *= *options.fit / longest;
  return world_from_design;
}

/// Makes the bodies of the objects in a haptic representation.
class BodyMaker {
 public:
  /// `check`: is there a judge?
  BodyMaker(const World& world, const session::HapticRepresentation& felt, bool check, DesignMotions& motions,
            const Affine3& world_from_design)
      : world_(world), felt_(felt), check_(check), motions_(motions), world_from_design_(world_from_design) {}

  TouchBody body(const haptics::HapticObject& object) {
    const world::PhysicalObject& of = *world_.find(*felt_.object(object.id));
    const world::GeometryPointer& shape = world_.find(of.geometry)->shape;
    const world::Geometry& geometry = *shape;
    const session::FeltShapePointer felt = felt_.felt(*felt_.object(object.id));
    TouchBody body{eyes_.eye(shape, felt), object.shape, object.world_from_object};
    body.course = motions_.of_body(*felt_.object(object.id), world_from_design_, *felt);
    body.primitive = felt->primitive;
    if (!body.eye) {
      body.csg = felt->solid;
      body.solid = std::dynamic_pointer_cast<const haptics::SmoothShape>(felt->shape);
    }
    if (check_) set_judged(body, geometry, *felt);
    body.exact = !felt->mesh;
    body.is_mesh = geometry.kind() == "mesh";
    body.closed = felt->closed;
    body.surface = object.surface;
    if (const world::Material* material = world_.find(of.material)) body.colour = colour_of(*material);
    return body;
  }

 private:
  void set_judged(TouchBody& body, const world::Geometry& geometry, const session::FeltShape& felt) {
    if (const auto* loop = dynamic_cast<const world::LoopGeometry*>(&geometry); loop && !felt.mesh) {
      body.judged = limit(*loop, felt);
    } else if (felt.inside) {
      body.membership = membership(geometry, felt);
    }
  }

  /// The limit's mesh in the felt frame; made once for all clones, none where the judge cannot make it.
  const JudgedMesh& limit(const world::LoopGeometry& loop, const session::FeltShape& felt) {
    const auto [made, fresh] = limits_.try_emplace(&felt);
    if (!fresh) return made->second;
    geometry::ControlMesh control = session::stretched(loop.control, felt.felt_from_geometry);
    for (base::Vector3& position : control.mesh.positions) position -= felt.middle;
    if (auto mesh = judged_limit(control)) made->second = std::move(*mesh);
    return made->second;
  }

  /// The inside, by plain evaluation where there is one; made once for all clones.
  const haptics::MembershipSolid& membership(const world::Geometry& geometry,
                                             const session::FeltShape& felt) {
    const auto [made, fresh] = memberships_.try_emplace(&felt);
    if (!fresh) return made->second;
    made->second = {felt.inside, felt.shape->bounds()};
    if (felt.solid) {
      made->second = haptics::plain_solid(*felt.solid);
    } else if (const auto* implicit = dynamic_cast<const world::ImplicitGeometry*>(&geometry)) {
      if (auto solid = negative_inside(implicit->formula(), *implicit->surface()))
        made->second = std::move(*solid);
    }
    return made->second;
  }

  static charts::Colour colour_of(const world::Material& material) {
    const auto channel = [&](std::size_t i) { return std::clamp(double(material.diffuse[i]), 0.0, 1.0); };
    return {channel(0), channel(1), channel(2)};
  }

  const World& world_;
  const session::HapticRepresentation& felt_;
  bool check_;
  DesignMotions& motions_;
  const Affine3& world_from_design_;
  DesignEyes eyes_;
  std::map<const session::FeltShape*, haptics::MembershipSolid> memberships_;
  std::map<const session::FeltShape*, JudgedMesh> limits_;
};

/// Adds the first sentences, and how many more there are.
void tell_sentences(TouchModel& model, const std::vector<std::string>& sentences) {
  const std::size_t count = std::min(sentences.size(), kMostSentences);
  model.repairs.insert(model.repairs.end(), sentences.begin(), sentences.begin() + std::ptrdiff_t(count));
  if (count < sentences.size())
    model.repairs.push_back(fmt::format("and {} more such sentences", sentences.size() - count));
}

std::vector<std::string> sentences_of(const files::LoadedDesign& design, const std::string& file) {
  std::vector<std::string> sentences;
  for (const files::Remark& remark : design.remarks) sentences.push_back(sentence(remark, file));
  return sentences;
}

/// Sentences on the repairs that were needed before objects could be felt.
std::vector<std::string> repairs_of(const World& world, const session::HapticRepresentation& felt) {
  std::vector<std::string> sentences;
  std::set<const session::FeltShape*> told;
  const auto& objects = felt.scene()->objects();
  for (const haptics::HapticObject& object : objects) {
    const world::ObjectId id = *felt.object(object.id);
    const session::FeltShapePointer shape = felt.felt(id);
    if (!told.insert(shape.get()).second) continue;
    const std::string& name = world.find(id)->name;
    for (const std::string& repair : shape->repairs)
      sentences.push_back(objects.size() == 1 || name.empty() ? repair
                                                              : fmt::format("\"{}\": {}", name, repair));
  }
  return sentences;
}

/// Applies --subdivide or the thesis's renderer to the bodies, where the options ask for it.
base::Result<void> render_as_asked(TouchModel& model, const TouchOptions& options) {
  const bool thesis = renderer_of(options) == haptics::Renderer::Thesis;
  for (TouchBody& body : model.bodies) {
    if (options.subdivision) {
      if (const auto made = subdivide(model, body, options); !made) return made;
    } else if (thesis) {
      if (const auto made = render_as_thesis(model, body, options); !made) return made;
    }
  }
  return {};
}

/// Sentences on the form of a CSG solid, and on how a tip with a radius feels the bodies.
std::vector<std::string> forms_of(const TouchModel& model, const TouchOptions& options) {
  std::vector<std::string> sentences;
  if (model.bodies.size() == 1 && model.body().csg) {
    const geometry::CsgCount count = geometry::count(*model.body().csg);
    sentences.push_back(
        fmt::format("{} primitives, {} nodes, {} deep", count.primitives, count.nodes, count.depth));
  }
  const auto without_mesh = [](const TouchBody& body) { return body.exact && !body.primitive; };
  if (options.radius > 0.0 && !options.subdivision && std::ranges::any_of(model.bodies, without_mesh)) {
    const bool all = std::ranges::all_of(model.bodies, [](const TouchBody& body) { return body.exact; });
    sentences.push_back(all ? "a tip with a radius feels it exactly"
                            : "a tip with a radius feels exactly what is not named as triangles here");
  }
  return sentences;
}

/// Gives all possible reasons, as parts left out of a file may be those that were to be touched.
tl::unexpected<base::Error> nothing_to_touch(const std::string& text, const files::LoadedDesign& design,
                                             const std::vector<std::string>& remarks) {
  constexpr std::size_t kMostReasons = 5;
  std::vector<std::string> reasons = remarks;
  for (const files::Remark& remark : design.remarks) reasons.push_back(remark.text);
  std::string all;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i) all += " " + reasons[i];
  return base::fail(
      fmt::format("{}: there is nothing to touch in it{}{}", text, all.empty() ? "." : ":", all));
}

}  // namespace

base::Result<TouchModel> load_design(const std::string& text, const TouchOptions& options) {
  const Stopwatch reading;
  const auto design = read_file(text, options);
  if (!design) return tl::unexpected(design.error());
  TouchModel model;
  model.name = shown_name(text);
  model.read_seconds = reading.seconds();
  session::HapticRepresentationSettings settings;
  settings.felt = {.tip_radius = options.radius,
                   .interpolate_normals = options.smooth_shading,
                   .with_time = true,
                   .shares_meshes = true};
  settings.world_from_design = placing(design->world, options);
  const Stopwatch building;
  DesignMotions motions(design->world, options.still);
  const World& world = motions.at_start();
  session::HapticRepresentation felt(settings);
  felt.show(world);

  const std::vector<std::string> remarks = felt.remarks(world);
  const auto& objects = felt.scene()->objects();
  model.effects = felt.effects();
  for (const haptics::PlacedEffect& effect : model.effects)
    model.effect_courses.push_back(motions.of_effect({effect.id}, settings.world_from_design));
  if (objects.empty() && model.effects.empty()) return nothing_to_touch(text, *design, remarks);
  model.bodies.clear();
  model.bodies.reserve(objects.size());
  BodyMaker maker(world, felt, options.check && !options.subdivision, motions, settings.world_from_design);
  for (const haptics::HapticObject& object : objects) model.bodies.push_back(maker.body(object));
  const std::size_t count = model.bodies.size();
  model.kind = count == 0   ? fmt::format("{}, effects alone", design->format)
               : count == 1 ? design->format
                            : fmt::format("{}, {} bodies", design->format, count);
  tell_sentences(model, sentences_of(*design, text));
  tell_sentences(model, repairs_of(world, felt));
  tell_sentences(model, motions.sentences());
  tell_sentences(model, remarks);
  if (const auto rendered = render_as_asked(model, options); !rendered)
    return tl::unexpected(rendered.error());
  for (const TouchBody& body : model.bodies) {
    if (!body.exact) model.triangles += body.eye->mesh()->triangles.size();
    if (options.check && body.exact && !body.primitive && !body.membership && !body.judged.mesh)
      return base::fail(text +
                        ": --check cannot judge a subdivision surface in it, which has too many triangles, "
                        "or edges of more than two: leave it out.");
  }
  tell_sentences(model, forms_of(model, options));
  model.build_seconds = building.seconds();
  return model;
}

}  // namespace icome::apps

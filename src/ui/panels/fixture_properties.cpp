#include "ui/panels/fixture_properties.h"

#include <cmath>
#include <numbers>

namespace icome::ui {

using base::Result;
using world::Light;
using world::ObjectId;
using world::World;

namespace {

template <typename Kind>
const Kind* fixture(const World& world, ObjectId id) {
  return std::get_if<Kind>(world.find(id)->fixture.get());
}

/// `read` gives a value of a light, or nothing where its kind has no such value; `write` sets one, or returns
/// the reason why it cannot.
template <typename Value, typename Read, typename Write>
Property<Value> light_property(const Read& read, const Write& write) {
  return {[read](const World& world, ObjectId id) -> std::optional<Value> {
            const Light* light = fixture<Light>(world, id);
            return light ? std::optional<Value>(read(*light)) : std::nullopt;
          },
          [write](const World& world, ObjectId id, const Value& value) -> Result<world::Edit> {
            Light changed = *fixture<Light>(world, id);
            const char* complaint = write(changed, value);
            if (complaint) return base::fail(complaint);
            return world::Edit(world::ChangeFixture{id, std::make_shared<const world::Fixture>(changed)});
          }};
}

template <typename Value>
Property<Value> plain_light(Value Light::*member) {
  return light_property<Value>([member](const Light& it) { return it.*member; },
                               [member](Light& it, const Value& value) -> const char* {
                                 it.*member = value;
                                 return nullptr;
                               });
}

Property<double> light_share(float Light::*member) {
  return light_property<double>([member](const Light& it) { return double(it.*member); },
                                [member](Light& it, double value) -> const char* {
                                  if (!(value >= 0.0 && value <= 1.0)) return "A share goes from 0 to 100 %.";
                                  it.*member = float(value);
                                  return nullptr;
                                });
}

Property<double> spot_angle(double Light::*member) {
  return light_property<double>(
      [member](const Light& it) {
        return it.kind == Light::Kind::Spot ? std::optional(it.*member) : std::nullopt;
      },
      [member](Light& it, double value) -> const char* {
        if (!(value > 0.0 && value <= std::numbers::pi / 2.0)) return "A spot's angles go up to 90°.";
        it.*member = value;
        return nullptr;
      });
}

}  // namespace

Property<int> light_kind() {
  return light_property<int>([](const Light& it) { return int(it.kind); },
                             [](Light& it, int kind) -> const char* {
                               it.kind = Light::Kind(kind);
                               return nullptr;
                             });
}
Property<bool> light_on() { return plain_light(&Light::on); }
Property<world::Colour> light_colour() { return plain_light(&Light::colour); }
Property<double> light_intensity() { return light_share(&Light::intensity); }
Property<double> light_ambient() { return light_share(&Light::ambient); }

Property<double> light_radius() {
  return light_property<double>(
      [](const Light& it) {
        return it.kind == Light::Kind::Directional ? std::nullopt : std::optional(it.radius);
      },
      [](Light& it, double value) -> const char* {
        if (!(std::isfinite(value) && value >= 0.0)) return "How far a light reaches cannot be less than 0.";
        it.radius = value;
        return nullptr;
      });
}
Property<double> light_cut_off() { return spot_angle(&Light::cut_off_angle); }
Property<double> light_beam() { return spot_angle(&Light::beam_width); }

Property<double> field_of_view() {
  return {[](const World& world, ObjectId id) -> std::optional<double> {
            const auto* view = fixture<world::Viewpoint>(world, id);
            return view ? std::optional(view->field_of_view) : std::nullopt;
          },
          [](const World&, ObjectId id, double value) -> Result<world::Edit> {
            if (!(value > 0.0 && value < std::numbers::pi))
              return base::fail(
                  "A field of view is more than 0° and less than 180°; eyes are used to 40° to 60°.");
            const world::Viewpoint view{value};
            return world::Edit(world::ChangeFixture{id, std::make_shared<const world::Fixture>(view)});
          }};
}

namespace {

/// `write` returns the changed effect, or an error.
template <typename Value, typename Write>
Property<Value> effect_property(Value world::ForceEffect::*member, const Write& write) {
  return {[member](const World& world, ObjectId id) -> std::optional<Value> {
            const auto* effect = fixture<world::ForceEffect>(world, id);
            return effect ? std::optional<Value>(effect->*member) : std::nullopt;
          },
          [write](const World& world, ObjectId id, const Value& value) -> Result<world::Edit> {
            auto changed = write(*fixture<world::ForceEffect>(world, id), value);
            if (!changed) return tl::unexpected(changed.error());
            return world::Edit(world::ChangeFixture{id, std::move(*changed)});
          }};
}

}  // namespace

Property<std::string> effect_text() {
  return effect_property(&world::ForceEffect::text,
                         [](const world::ForceEffect& it, const std::string& text) {
                           return interaction::make_effect_fixture(text, it.on);
                         });
}

Property<double> effect_number(const interaction::EffectDial& dial) {
  return {[dial](const World& world, ObjectId id) -> std::optional<double> {
            const auto* effect = fixture<world::ForceEffect>(world, id);
            return effect ? interaction::dial_value(dial, effect->text) : std::nullopt;
          },
          [dial](const World& world, ObjectId id, double value) -> Result<world::Edit> {
            const auto& effect = *fixture<world::ForceEffect>(world, id);
            auto made = interaction::make_effect_fixture(with_dial(dial, effect.text, value), effect.on);
            if (!made) return tl::unexpected(made.error());
            return world::Edit(world::ChangeFixture{id, std::move(*made)});
          }};
}

/// Works also for an effect with a text that this program does not know: the text is kept.
Property<bool> effect_on() {
  return effect_property(&world::ForceEffect::on,
                         [](const world::ForceEffect& it, bool on) -> Result<world::FixturePointer> {
                           return std::make_shared<const world::Fixture>(world::ForceEffect{it.text, on});
                         });
}

}  // namespace icome::ui

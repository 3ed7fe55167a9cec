#include "files/mesh/mtl_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parse_number.h"
#include "io/number_text.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

using world::Colour;

// Shininess: OBJ writes the exponent, VRML 2.0 a share of the largest that OpenGL knew.
constexpr float kLargestExponent = 128.0F;

/// Reads one text; nothing in it is an error.
class MtlReading {
 public:
  MtlReading(std::string_view text, std::vector<std::string>& notes)
      : scanner_(text, "", io::TextScanner::Lines::Matter, '#'), notes_(notes) {}

  std::vector<MtlMaterial> run() {
    while (!scanner_.at_end()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "newmtl") {
        finish_one();
        MtlMaterial& it = materials_.emplace_back();
        it.material.name = scanner_.rest();
      } else if (!materials_.empty()) {
        read(keyword, materials_.back());
      }
      scanner_.skip_line();
    }
    finish_one();
    tell_names("Left out of materials: ", words_);
    tell_names("Left out of pictures: the options ", options_);
    return std::move(materials_);
  }

 private:
  void read(std::string_view keyword, MtlMaterial& it) {
    if (keyword == "Kd") {
      it.material.diffuse = colour(it.material.diffuse);
    } else if (keyword == "Ka") {
      ambient_ = colour({-1.0F, -1.0F, -1.0F});
    } else if (keyword == "Ks") {
      it.material.specular = colour({});
    } else if (keyword == "Ke") {
      it.material.emission = colour({});
    } else if (keyword == "Ns") {
      it.material.shininess = std::clamp(number().value_or(0.0F) / kLargestExponent, 0.0F, 1.0F);
    } else if (keyword == "d") {
      it.material.transparency = std::clamp(1.0F - number().value_or(1.0F), 0.0F, 1.0F);
    } else if (keyword == "Tr") {
      it.material.transparency = std::clamp(number().value_or(0.0F), 0.0F, 1.0F);
    } else if (keyword == "map_Kd") {
      read_picture(it);
    } else if (keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "norm") {
      note("Maps other than of the diffuse colour are left out.");
    } else if (is_of_physical_look(keyword) && number().value_or(0.0F) != 0.0F) {
      add_name(keyword, words_);
    }
  }

  /// "-clamp on -s 2 2 1 name of a file.png": options have a known number of values.
  void read_picture(MtlMaterial& it) {
    std::string_view rest = scanner_.rest();
    std::array<double, 2> stretch = {1.0, 1.0}, shift = {0.0, 0.0};
    while (rest.starts_with('-')) {
      const std::string_view option = take_word(rest);
      if (option == "-clamp") {
        const bool clamped = take_word(rest) == "on";
        it.repeats = {!clamped, !clamped};
      } else if (option == "-s") {
        stretch = numbers_of_option(rest, 1.0);
      } else if (option == "-o") {
        shift = numbers_of_option(rest, 0.0);
      } else if (option == "-t") {
        numbers_of_option(rest, 0.0);
        note("Noise that distorts pictures is left out.");
      } else if (option == "-mm") {
        const std::array<double, 2> range = numbers_of_option(rest, 0.0);
        if (range != std::array{0.0, 1.0}) add_name(option, options_);
      } else {
        take_word(rest);
        if (option != "-blendu" && option != "-blendv") add_name(option, options_);
      }
    }
    it.picture = rest;
    // The picture's colours are multiplied with the diffuse colour.
    it.material.tints = true;
    it.material.picture_frame = {stretch[0], 0.0, shift[0], 0.0, stretch[1], shift[1]};
  }

  /// Metal, roughness, sheen, clear coat and anisotropy, which later programs added.
  static bool is_of_physical_look(std::string_view keyword) {
    constexpr std::array<std::string_view, 7> kWords{"Pm", "Pr", "Ps", "Pc", "Pcr", "aniso", "anisor"};
    return std::find(kWords.begin(), kWords.end(), keyword) != kWords.end();
  }

  /// Adds each name once, up to a number that a remark can list.
  static void add_name(std::string_view name, std::vector<std::string>& names) {
    constexpr std::size_t kMostNames = 12, kLongestName = 20;
    const std::string kept(name.substr(0, kLongestName));
    if (names.size() < kMostNames && std::find(names.begin(), names.end(), kept) == names.end())
      names.push_back(kept);
  }

  void tell_names(const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) notes_.push_back(fmt::format("{}{}.", what, fmt::join(names, ", ")));
  }

  /// The first two of up to three numbers; missing ones are `otherwise`.
  static std::array<double, 2> numbers_of_option(std::string_view& rest, double otherwise) {
    std::array<double, 2> numbers = {otherwise, otherwise};
    for (std::size_t i = 0; i < 3 && begins_with_number(rest); ++i) {
      const double value = base::number_at_front<double>(take_word(rest)).value;
      if (i < numbers.size() && std::isfinite(value)) numbers[i] = value;
    }
    return numbers;
  }

  static std::string_view take_word(std::string_view& rest) {
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(end);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    return word;
  }
  static bool begins_with_number(std::string_view rest) {
    return base::parse_number<double>(take_word(rest)).has_value();
  }

  std::optional<float> number() {
    const auto read = base::number_at_front<float>(scanner_.word());
    return read.good() && std::isfinite(read.value) ? std::optional(read.value) : std::nullopt;
  }

  /// A colour of three numbers; one number stands for grey.
  Colour colour(const Colour& otherwise) {
    const auto red = number();
    if (!red) return otherwise;
    const auto green = number();
    const auto blue = number();
    Colour result{*red, green.value_or(*red), blue.value_or(*red)};
    for (float& part : result) part = std::clamp(part, 0.0F, 1.0F);
    return result;
  }

  /// VRML 2.0's ambient light is a share of the diffuse colour. Many programs write white for any.
  void finish_one() {
    if (materials_.empty()) return;
    world::Material& material = materials_.back().material;
    const float diffuse = material.diffuse[0] + material.diffuse[1] + material.diffuse[2];
    const float ambient = ambient_[0] + ambient_[1] + ambient_[2];
    if (ambient_[0] >= 0.0F && diffuse > 0.0F && ambient <= diffuse) material.ambient = ambient / diffuse;
    ambient_ = {-1.0F, -1.0F, -1.0F};
  }

  void note(const char* text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.emplace_back(text);
  }

  io::TextScanner scanner_;
  std::vector<std::string>& notes_;
  std::vector<MtlMaterial> materials_;
  std::vector<std::string> words_, options_;  // that are left out
  Colour ambient_ = {-1.0F, -1.0F, -1.0F};
};

void append_colour(std::string& text, const char* keyword, const Colour& colour) {
  text += keyword;
  for (const float part : colour) {
    text += ' ';
    io::append_number(text, part);
  }
  text += '\n';
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, std::vector<std::string>& notes) {
  return MtlReading(text, notes).run();
}

std::string mtl_text(const world::Material& material, const ShownMaterial& shown, const std::string& name,
                     const std::string& picture, std::array<bool, 2> repeats) {
  Colour ambient = shown.colour;
  for (float& part : ambient) part *= material.ambient;
  std::string text = "newmtl " + name + "\n";
  append_colour(text, "Ka", ambient);
  append_colour(text, "Kd", shown.colour);
  append_colour(text, "Ks", material.specular);
  append_colour(text, "Ke", material.emission);
  text += "Ns ";
  io::append_number(text, kLargestExponent * material.shininess);
  text += "\nd ";
  io::append_number(text, shown.opacity);
  text += "\nillum 2\n";
  if (!picture.empty())
    text += fmt::format("map_Kd {}{}\n", repeats[0] || repeats[1] ? "" : "-clamp on ", picture);
  return text;
}

}  // namespace icome::files

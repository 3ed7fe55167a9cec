#include "apps/speech/talk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/design/design_work.h"
#include "apps/terminal.h"
#include "base/decompositions.h"
#include "base/parse_number.h"
#include "files/design_files.h"
#include "io/file_bytes.h"
#include "io/number_rows.h"

namespace icome::apps {
namespace {

using base::Result;
using base::Vector3;

constexpr std::uint64_t kLongestVocabulary = 10'000'000;  // bytes
constexpr std::uint64_t kLongestHand = 1U << 30U;
constexpr std::size_t kPlace = 3, kRay = 6;

/// The hand of x, y, z and perhaps dx, dy, dz.
Result<speech::Pointer> pointer_of(std::span<const double> numbers) {
  speech::Pointer pointer;
  pointer.world_from_pointer.translation() = Vector3(numbers[0], numbers[1], numbers[2]);
  if (numbers.size() < kRay) return pointer;
  const Vector3 way(numbers[3], numbers[4], numbers[5]);
  if (!(way.norm() > 0.0)) return base::fail("the hand must point somewhere: dx,dy,dz cannot all be 0");
  pointer.world_from_pointer.linear() =
      base::rotation_between(-Vector3::UnitZ(), way.normalized()).toRotationMatrix();
  return pointer;
}

}  // namespace

std::optional<speech::Pointer> HandPath::at(double time) const {
  const auto next = std::ranges::upper_bound(rows, time, {}, &Row::time);
  return next == rows.begin() ? std::nullopt : std::optional(std::prev(next)->pointer);
}

Result<HandPath> hand_from_text(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = base::parse_number<double>(std::string_view(text).substr(begin, end - begin));
    numbers.push_back(number.value_or(std::nan("")));
    begin = end + 1;
  }
  const bool all_good = std::ranges::all_of(numbers, [](double it) { return std::isfinite(it); });
  if (!all_good || (numbers.size() != kPlace && numbers.size() != kRay))
    return base::fail(fmt::format(
        "--pointer '{}' is no hand: write x,y,z (m), or x,y,z,dx,dy,dz to say where it points", text));
  const auto pointer = pointer_of(numbers);
  if (!pointer) return base::fail("--pointer: " + pointer.error().message);
  return HandPath{{{-HUGE_VAL, *pointer}}};
}

Result<HandPath> hand_from_file(const std::filesystem::path& file) {
  const auto text = io::read_bytes(file, kLongestHand);
  if (!text) return tl::unexpected(text.error());
  HandPath path;
  const auto add = [&](std::span<const double> row) -> Result<void> {
    if (!path.rows.empty() && row[0] < path.rows.back().time) return base::fail("times must not go back");
    const auto pointer = pointer_of(row.subspan(1));
    if (!pointer) return tl::unexpected(pointer.error());
    path.rows.push_back({row[0], *pointer});
    return {};
  };
  const std::string_view first = std::string_view(*text).substr(0, text->find_first_of("\r\n"));
  // Columns of two letters have no place in rows of numbers by letters; this file may have them.
  const bool points = std::ranges::count(first, ',') == std::ptrdiff_t(kRay);
  std::string plain = *text;
  if (points && first == "t,x,y,z,dx,dy,dz") plain.replace(0, first.size(), "t,x,y,z,u,v,w");
  const auto read = io::read_number_rows(plain, file.string(), points ? "txyzuvw" : "txyz", add);
  if (!read) return tl::unexpected(read.error());
  return path;
}

Result<speech::Vocabulary> vocabulary_of(const TalkOptions& talk) {
  auto vocabulary = speech::built_in_vocabulary();
  if (!vocabulary) return vocabulary;
  for (const std::filesystem::path& file : talk.vocabularies) {
    const auto text = io::read_bytes(file, kLongestVocabulary);
    if (!text) return tl::unexpected(text.error());
    if (const auto added = speech::add_vocabulary(*vocabulary, *text, file.string()); !added)
      return tl::unexpected(added.error());
  }
  return vocabulary;
}

Talk::Talk(const TalkOptions& options, const files::LoadedDesign& design, speech::Vocabulary vocabulary,
           speech::OwnWords own_words)
    : options_(options),
      file_(design),
      vocabulary_(std::move(vocabulary)),
      runner_(design.world),
      own_words_(std::move(own_words)),
      dialogue_(vocabulary_, runner_, stage_, own_words_) {}

Result<std::unique_ptr<Talk>> Talk::open(const TalkOptions& options, StatusLine& status) {
  auto vocabulary = vocabulary_of(options);
  if (!vocabulary) return tl::unexpected(vocabulary.error());
  auto own_words =
      speech::OwnWords::open(options.words.empty() ? speech::OwnWords::usual_file() : options.words);
  if (!own_words) return tl::unexpected(own_words.error());
  auto design = options.design == kNewDesign ? Result<files::LoadedDesign>(files::LoadedDesign{})
                                             : read_for_person(options.design, {}, status);
  if (!design) return tl::unexpected(design.error());
  status.clear();
  for (const std::string& remark : first_sentences(design->remarks, options.design)) tell(remark);
  return std::unique_ptr<Talk>(new Talk(options, *design, std::move(*vocabulary), std::move(*own_words)));
}

std::unique_ptr<Talk> Talk::beginning() const {
  files::LoadedDesign now = file_;
  now.world = runner_.world();
  std::unique_ptr<Talk> talk(new Talk(options_, now, vocabulary_, own_words_));
  talk->own_words_.keep_nothing();
  talk->stage_.hand = stage_.hand;
  talk->stage_.select(stage_.selection());
  return talk;
}

Result<void> Talk::save(const std::filesystem::path& out, bool force) const {
  if (const auto free = check_can_replace(out, options_.design, file_); !force && !free) return free;
  const auto losses = files::write_design(out, runner_.world());
  if (!losses) return tl::unexpected(losses.error());
  for (const std::string& loss : first_sentences(*losses, out.string())) tell(loss);
  return {};
}

}  // namespace icome::apps

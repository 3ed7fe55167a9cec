#include "animation/export/film.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "animation/export/ffmpeg.h"
#include "animation/sound/sound_track.h"
#include "io/new_file.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;
using Words = std::vector<std::string>;

constexpr int kTrackRate = 48000;  // Hz, which both AAC and Opus know
constexpr int kOutDescriptor = 3, kSoundDescriptor = 4, kPaletteDescriptor = 5;

/// A file without a name, which goes with its end.
using NamelessFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Result<NamelessFile> nameless_file() {
  NamelessFile file(std::tmpfile(), std::fclose);
  if (!file)
    return fail(fmt::format("a temporary file cannot be made: {}; is the disk full?", std::strerror(errno)));
  return file;
}

std::string handed(int descriptor) { return fmt::format("/dev/fd/{}", descriptor); }

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

bool knows_sound(OutputFormat format) { return format == OutputFormat::Mp4 || format == OutputFormat::WebM; }

/// Frames as they are fed: without a background their colours are not premultiplied.
Words input_words(const FrameMaker& maker) {
  return {"-f",
          "rawvideo",
          "-pixel_format",
          maker.has_background() ? "bgr0" : "rgba",
          "-video_size",
          fmt::format("{}x{}", maker.width(), maker.height()),
          "-framerate",
          fmt::format("{:.17g}", maker.project().stage.rate),
          "-i",
          "pipe:0"};
}

std::string as_fed(const Pixels& pixels, bool background) {
  if (!background) {
    const charts::Image image = image_of(pixels);
    return {reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size()};
  }
  if constexpr (std::endian::native == std::endian::little)
    return {reinterpret_cast<const char*>(pixels.words.data()), pixels.bytes()};
  std::string bytes;
  for (const std::uint32_t word : pixels.words)
    for (unsigned c = 0; c < 4; ++c) bytes += char(word >> (8 * c) & 0xffU);
  return bytes;
}

/// Colours of high-definition television, converted by whole numbers that are the same on every processor.
constexpr const char* kToVideo =
    "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format={}";
const Words kVideoColours = {"-colorspace", "bt709", "-color_primaries", "bt709",
                             "-color_trc",  "bt709", "-color_range",     "tv"};

/// The threads of encoders are as many on every machine, as what they write depends on it.
Words codec_words(OutputFormat format, bool background) {
  Words words;
  switch (format) {
    case OutputFormat::Mp4:
      words = {"-vf",        fmt::format(fmt::runtime(kToVideo), "yuv420p"),
               "-c:v",       "libx264",
               "-preset",    "medium",
               "-crf",       "17",
               "-threads:v", "4"};
      append(words, kVideoColours);
      append(words, {"-c:a", "aac", "-b:a", "192k", "-movflags", "+faststart", "-f", "mp4"});
      break;
    case OutputFormat::WebM:
      words = {"-vf",           fmt::format(fmt::runtime(kToVideo), background ? "yuv420p" : "yuva420p"),
               "-c:v",          "libvpx-vp9",
               "-crf",          "20",
               "-b:v",          "0",
               "-deadline",     "good",
               "-cpu-used",     "3",
               "-row-mt",       "0",
               "-auto-alt-ref", background ? "1" : "0",
               "-threads:v",    "4"};
      append(words, kVideoColours);
      append(words, {"-c:a", "libopus", "-b:a", "128k", "-f", "webm"});
      break;
    case OutputFormat::Gif:
      words = {"-lavfi", "[0:v][1:v]paletteuse=dither=sierra2_4a:diff_mode=rectangle", "-loop", "0", "-f",
               "gif"};
      break;
    case OutputFormat::Apng:
      words = {"-vf",    background ? "format=rgb24" : "format=rgba",
               "-c:v",   "apng",
               "-pred",  "mixed",
               "-plays", "0",
               "-f",     "apng"};
      break;
    case OutputFormat::Png:
    case OutputFormat::Svg:
      break;
  }
  return words;
}

const Words kExact = {"-map_metadata", "-1",        "-fflags",  "+bitexact",
                      "-flags:v",      "+bitexact", "-flags:a", "+bitexact"};

/// Feeds all frames; the work counts as the part from `begin` to `end` of the whole.
Result<void> feed_frames(FrameMaker& maker, Ffmpeg& ffmpeg, double begin, double end) {
  const FrameRange& range = maker.range();
  for (int i = 0; i < range.count(); ++i) {
    const double part = begin + (end - begin) * i / range.count();
    if (!maker.goes_on(part)) return stopped_export();
    const auto drawn = maker.draw(range.first + i);
    if (!drawn) return tl::unexpected(drawn.error());
    const std::string bytes = as_fed(**drawn, maker.has_background());
    if (auto fed = ffmpeg.feed(bytes, [&] { return maker.goes_on(part); }); !fed) return fed;
  }
  return ffmpeg.finish([&] { return maker.goes_on(end); });
}

/// GIF has 256 colours: those that serve all frames best, as a picture of a file.
Result<NamelessFile> palette_of(FrameMaker& maker) {
  auto palette = nameless_file();
  if (!palette) return palette;
  Words words = input_words(maker);
  append(words, {"-vf", fmt::format("palettegen=stats_mode=full:reserve_transparent={}",
                                    maker.has_background() ? 0 : 1)});
  append(words, kExact);
  append(words, {"-frames:v", "1", "-c:v", "png", "-f", "image2pipe", handed(kPaletteDescriptor)});
  auto ffmpeg = Ffmpeg::start(words, {{::fileno(palette->get()), kPaletteDescriptor}});
  if (!ffmpeg) return tl::unexpected(ffmpeg.error());
  if (const auto fed = feed_frames(maker, *ffmpeg, 0, 0.4); !fed) return tl::unexpected(fed.error());
  return palette;
}

/// The sound of the frames as 16-bit samples without a header.
struct FilmSound {
  NamelessFile file;
  int channels;
};

/// None where the project's sound cannot be read, which the report tells.
Result<std::optional<FilmSound>> film_sound(const FrameMaker& maker, ExportReport& report) {
  const Sound& sound = *maker.project().sound;
  const auto track =
      read_track(maker.pictures().folder(), sound, kTrackRate, maker.pictures().options().reach);
  if (!track) {
    report.remarks.push_back(fmt::format("The film is silent: {}.", track.error().message));
    report.is_whole = false;
    return std::nullopt;
  }
  auto file = nameless_file();
  if (!file) return tl::unexpected(file.error());
  const double rate = maker.project().stage.rate;
  const FrameRange& range = maker.range();
  const std::int64_t first = std::llround(range.first / rate * kTrackRate);
  const std::int64_t end = std::llround((double(range.last) + 1) / rate * kTrackRate);
  for (std::int64_t at = first; at < end; at += kTrackRate) {
    const auto moments = std::size_t(std::min<std::int64_t>(kTrackRate, end - at));
    std::string bytes;
    for (const float value : sound_of(*track, sound, double(at) / kTrackRate, moments)) {
      const auto number = std::uint16_t(std::int16_t(std::lround(32767.0F * value)));
      bytes += char(number & 0xffU);
      bytes += char(number >> 8U);
    }
    if (std::fwrite(bytes.data(), 1, bytes.size(), file->get()) != bytes.size())
      return fail(fmt::format("the sound cannot be written to a temporary file: {}", std::strerror(errno)));
  }
  if (std::fflush(file->get()) != 0)
    return fail(fmt::format("the sound cannot be written to a temporary file: {}", std::strerror(errno)));
  return FilmSound{std::move(*file), track->channels};
}

Words sound_words(const FilmSound& sound) {
  return {"-f",  "s16le",
          "-ar", fmt::format("{}", kTrackRate),
          "-ac", fmt::format("{}", sound.channels),
          "-i",  handed(kSoundDescriptor)};
}

/// Tells in which ways a film of that format is not as the project is.
void tell_limits(const FrameMaker& maker, OutputFormat format, bool padded, ExportReport& report) {
  if (padded)
    report.remarks.push_back(fmt::format(
        "The film is {} x {} px, as its sides must be even: what lies beyond the right and the lower "
        "rim is seen there.",
        maker.width(), maker.height()));
  if (format == OutputFormat::Mp4 && !maker.options().background)
    report.remarks.emplace_back("MP4 knows nothing clear, so the background is shown.");
  if (maker.project().sound && maker.options().sound && !knows_sound(format))
    report.remarks.push_back(fmt::format("{} has no sound, so it is left out.", report.format));
  const double hundredths = 100 / maker.project().stage.rate;
  if (format == OutputFormat::Gif && std::abs(hundredths - std::round(hundredths)) > 1e-6)
    report.remarks.push_back(fmt::format(
        "GIF counts in hundredths of a second, so single frames last up to 0.01 s more or less than "
        "1/{:g} s; the whole is as long as it should be.",
        maker.project().stage.rate));
  if (format == OutputFormat::Gif && hundredths < 2 - 1e-6)
    report.remarks.emplace_back("Browsers show GIF with at most 50 frames a second.");
}

}  // namespace

Result<void> write_film(FrameMaker& maker, const OutputNames& names, ExportReport& report) {
  const OutputFormat format = names.format;
  const bool is_video = knows_sound(format);
  const bool padded = is_video && maker.make_even();
  tell_limits(maker, format, padded, report);
  auto out = io::NewFile::create(names.of(maker.range().first));
  if (!out) return tl::unexpected(out.error());

  Words words = input_words(maker);
  std::vector<Ffmpeg::HandedFile> files = {{out->descriptor(), kOutDescriptor}};
  double begin = 0;
  std::optional<FilmSound> sound;
  std::optional<NamelessFile> palette;
  if (maker.project().sound && maker.options().sound && is_video) {
    auto made = film_sound(maker, report);
    if (!made) return tl::unexpected(made.error());
    sound = std::move(*made);
  }
  if (sound) {
    append(words, sound_words(*sound));
    files.push_back({::fileno(sound->file.get()), kSoundDescriptor});
  }
  if (format == OutputFormat::Gif) {
    auto made = palette_of(maker);
    if (!made) return tl::unexpected(made.error());
    palette = std::move(*made);
    begin = 0.4;
    append(words, {"-i", handed(kPaletteDescriptor)});
    files.push_back({::fileno(palette->get()), kPaletteDescriptor});
  }
  append(words, codec_words(format, maker.has_background()));
  append(words, kExact);
  words.push_back(handed(kOutDescriptor));
  auto ffmpeg = Ffmpeg::start(words, files);
  if (!ffmpeg) return tl::unexpected(ffmpeg.error());
  if (const auto fed = feed_frames(maker, *ffmpeg, begin, 1); !fed) return fed;
  if (const auto finished = out->finish(); !finished) return finished;
  report.files.push_back(names.of(maker.range().first).string());
  return {};
}

}  // namespace icome::animation

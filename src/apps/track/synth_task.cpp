#include <fmt/format.h>

#include <system_error>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "apps/track/making_tasks.h"
#include "apps/track/track_work.h"
#include "apps/track/truth_file.h"
#include "cutout/source/picture_bytes.h"
#include "io/new_file.h"

namespace icome::apps {
namespace {

base::Result<void> write_whole(const std::filesystem::path& path, const std::string& bytes) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(bytes);
  return file->finish();
}

base::Result<cutout::SyntheticOptions> synthetic_options(const TrackOptions& options) {
  cutout::SyntheticOptions made;
  const auto size = size_of(options.camera_size);
  if (!size) return tl::unexpected(size.error());
  if (*size) {
    made.width = (*size)->first;
    made.height = (*size)->second;
  }
  if (!options.table.empty()) {
    made.table_width = options.table[0];
    made.table_height = options.table[1];
  }
  made.known = cutout::usual_triangles(int(options.triangles));
  if (!options.known.empty()) {
    auto known = cutout::read_known_triangles(options.known);
    if (!known) return tl::unexpected(known.error());
    made.known = std::move(*known);
  }
  made.frames = options.frames > 0 ? int(options.frames) : options.board ? 14 : 100;
  if (options.rate > 0) made.rate = options.rate;
  made.moving = !options.still;
  made.hands = options.hands;
  made.occlude = options.occlude;
  made.thickness = options.thickness;
  made.tilt = options.tilt;
  made.light = options.light;
  made.exposure = options.exposure;
  made.noise = options.noise;
  made.jpeg_quality = options.quality;
  made.blur = options.blur;
  made.photos = options.photos;
  made.seed = options.seed;
  if (const auto good = cutout::check(made); !good) return tl::unexpected(good.error());
  return made;
}

base::Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    return base::fail(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  if (!std::filesystem::is_empty(folder, error))
    return base::fail(fmt::format("{}: the folder is not empty; name a new one", folder.string()));
  return {};
}

base::Result<void> write_frame(const cutout::SyntheticTable::Made& made, const std::filesystem::path& folder,
                               int number) {
  const std::filesystem::path path =
      folder / fmt::format("frame{:06}.{}", number, made.jpeg.empty() ? "png" : "jpg");
  if (!made.jpeg.empty()) return write_whole(path, made.jpeg);
  const auto png = cutout::encode_png(made.frame.view());
  if (!png) return tl::unexpected(png.error());
  return write_whole(path, *png);
}

}  // namespace

int run_track_synth(const TrackOptions& options) {
  const auto made_of = synthetic_options(options);
  if (!made_of) return track_failed(made_of.error());
  if (const auto ready = make_folder(options.synth); !ready) return track_failed(ready.error());
  StatusLine status;
  status.say("Laying the table");
  const cutout::SyntheticTable table(*made_of);
  if (options.hands && !options.photos.empty() && table.photos() == 0)
    tell(fmt::format("{}: there is no PNG picture with opacity; hands are drawn", options.photos.string()));
  TruthFile truth;
  truth.rate = made_of->rate;
  for (const cutout::KnownTriangle& triangle : made_of->known.triangles) truth.ids.push_back(triangle.id);
  for (int i = 0; i < made_of->frames; ++i) {
    if (interrupted()) break;
    status.progress("Making", double(i), double(made_of->frames), "frames");
    const auto made = options.board ? table.make_board(i) : table.make(i);
    if (const auto written = write_frame(made, options.synth, i); !written)
      return track_failed(written.error());
    truth.frames.push_back(made.truth);
  }
  status.clear();
  if (!options.board) {
    if (const auto written = write_whole(options.synth / "truth.json", truth_text(truth)); !written)
      return track_failed(written.error());
    if (const auto written =
            write_whole(options.synth / "known.toml", cutout::known_triangles_text(made_of->known));
        !written)
      return track_failed(written.error());
  }
  const char* const view_name = options.board ? "truth_view.toml" : "view.toml";
  if (const auto written = cutout::write_table_view(table.view(), options.synth / view_name); !written)
    return track_failed(written.error());
  const std::string folder = options.synth.string();
  if (interrupted()) {
    tell(fmt::format("{}: {} of {} frames were made; their truth is written", folder, truth.frames.size(),
                     made_of->frames));
    return kTrackInterrupted;
  }
  if (options.board)
    return print_answer(
        fmt::format("{0}: {1} pictures of the chessboard; icome track {0} --calibrate view.toml\n", folder,
                    made_of->frames));
  return print_answer(
      fmt::format("{0}: {1} frames with their truth; icome track {0} --known {0}/known.toml --view "
                  "{0}/view.toml --truth {0}/truth.json\n",
                  folder, made_of->frames));
}

}  // namespace icome::apps

#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "cutout/synth/synthetic_table.h"

namespace icome::apps {

/// The true poses in frames that were made: by frame, in the order of the known list.
struct TruthFile {
  double rate = 30;  // frames/s
  std::vector<std::string> ids;
  std::vector<cutout::FrameTruth> frames;
};

base::Result<TruthFile> read_truth(const std::filesystem::path& path);
std::string truth_text(const TruthFile& truth);

/// Compares sightings with the truth, frame by frame.
class TruthJudge {
 public:
  /// Fails where a triangle of the list is not in the truth.
  static base::Result<TruthJudge> create(TruthFile truth, const cutout::KnownTriangles& known);

  void judge(std::size_t frame, const std::vector<cutout::Sighting>& sightings);

  double rate() const { return truth_.rate; }
  std::size_t wanted() const { return wanted_; }  ///< triangles in the frames that were judged
  std::size_t found() const { return found_; }
  std::size_t ghosts() const { return ghosts_; }  ///< sightings where no triangle lies
  std::size_t swaps() const { return swaps_; }    ///< sightings where another triangle lies
  double recall() const { return wanted_ > 0 ? double(found_) / double(wanted_) : 0.0; }
  double position_rms() const;                      ///< mm
  double angle_rms() const;                         ///< rad
  double worst_position() const { return worst_; }  ///< mm

 private:
  TruthFile truth_;
  std::vector<std::size_t> place_in_truth_;  // of each known triangle
  std::size_t wanted_ = 0, found_ = 0, ghosts_ = 0, swaps_ = 0;
  double square_mm_ = 0, square_rad_ = 0, worst_ = 0;
};

}  // namespace icome::apps

#include "world/edit/flat_bytes.h"

namespace icome::world {
namespace {

constexpr std::uintptr_t kWidestNumber = 8;

bool readable_at(const char* place) { return reinterpret_cast<std::uintptr_t>(place) % kWidestNumber == 0; }

}  // namespace

FlatReader::FlatReader(std::string_view bytes) : bytes_(bytes), left_(bytes.size()) {
  if (readable_at(bytes.data())) return;
  // A short string lies within itself, where numbers may be misaligned: makes it a long one.
  copy_.reserve(bytes.size() + 64);
  copy_ = bytes;
  bytes_ = copy_;
}

void FlatReader::refuse(const std::string& why) {
  if (fault_.empty()) fault_ = why;
}

bool FlatReader::take(std::size_t bytes) {
  if (bytes > left_) {
    refuse("The bytes of a shape or an edit are damaged: they stand for more than they hold.");
    return false;
  }
  left_ -= bytes;
  return true;
}

std::array<double, 12> frame_numbers(const Affine3& frame) {
  std::array<double, 12> result;
  Eigen::Map<Eigen::Matrix<double, 3, 4>>(result.data()) = frame.affine();
  return result;
}

Affine3 frame_of(const std::array<double, 12>& numbers) {
  Affine3 result = Affine3::Identity();
  result.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(numbers.data());
  return result;
}

}  // namespace icome::world

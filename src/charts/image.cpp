#include "charts/image.h"

#include <cairo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

namespace icome::charts {
namespace {

constexpr int kMaxSide = 32767;  // the largest side of Cairo's image surface

using CairoImage = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

/// Cairo's pixel: premultiplied, one native-endian 32-bit word.
std::uint32_t premultiplied(const std::uint8_t* pixel) {
  const std::uint32_t alpha = pixel[3];
  const auto times_alpha = [&](std::uint8_t channel) { return (channel * alpha + 127) / 255; };
  return alpha << 24 | times_alpha(pixel[0]) << 16 | times_alpha(pixel[1]) << 8 | times_alpha(pixel[2]);
}

CairoImage surface_of(const Image& image) {
  CairoImage surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height),
                     cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return surface;
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t word = premultiplied(image.pixel(x, y));
      std::memcpy(data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(bytes);
  out.insert(out.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

/// Writes all bytes and closes the file; returns 0, or the errno of the failure.
int write_and_close(int file, const std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      close(file);
      return error;
    }
    done += static_cast<std::size_t>(count);
  }
  const int synced = fsync(file) == 0 ? 0 : errno;
  return close(file) == 0 ? synced : errno;
}

base::Result<void> write_atomically(const std::vector<std::uint8_t>& bytes,
                                    const std::filesystem::path& path) {
  const std::string temporary = fmt::format("{}.{}.tmp", path.string(), getpid());
  const auto failed = [&](int error) {
    return base::fail(fmt::format("{}: cannot write the picture: {}; choose a folder that can be written",
                                  path.string(), std::strerror(error)));
  };
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return failed(errno);
  int error = write_and_close(file, bytes);
  if (error == 0 && rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return {};
  unlink(temporary.c_str());
  return failed(error);
}

}  // namespace

base::Result<std::vector<std::uint8_t>> encode_png(const Image& image) {
  const bool fits =
      image.width > 0 && image.height > 0 && image.width <= kMaxSide && image.height <= kMaxSide;
  if (!fits) {
    return base::fail(fmt::format("a PNG picture of {}x{} cannot be made; sides go from 1 to {} pixels",
                                  image.width, image.height, kMaxSide));
  }
  const CairoImage surface = surface_of(image);
  std::vector<std::uint8_t> bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    return base::fail(fmt::format("the PNG picture cannot be made: {}", cairo_status_to_string(status)));
  }
  return bytes;
}

base::Result<void> write_png(const Image& image, const std::filesystem::path& path) {
  const auto bytes = encode_png(image);
  if (!bytes) return base::fail(bytes.error().message);
  return write_atomically(*bytes, path);
}

}  // namespace icome::charts

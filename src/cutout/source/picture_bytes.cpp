#include "cutout/source/picture_bytes.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <memory>

#include "io/jpeg_markers.h"

namespace icome::cutout {
namespace {

constexpr std::string_view kPngBegins = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegBegins = "\xff\xd8\xff";

using OwnedJpeg = std::unique_ptr<void, decltype(&tjDestroy)>;

base::Result<void> check_sides(int width, int height, const std::string& name) {
  if (width >= 1 && height >= 1 && width <= kMostPictureSide && height <= kMostPictureSide) return {};
  return base::fail(fmt::format("{}: it is {} x {} pixels large; {} x {} are the most that are read", name,
                                width, height, kMostPictureSide, kMostPictureSide));
}

/// Takes the pixels of a PNG file in a format of libpng's.
base::Result<void> read_png(std::string_view bytes, const std::string& name, png_uint_32 format,
                            std::vector<std::uint8_t>& pixels, int& width, int& height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owned(&image, png_image_free);
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    return base::fail(fmt::format("{}: it is no whole PNG file: {}", name, image.message));
  if (image.width > kMostPictureSide || image.height > kMostPictureSide)
    return check_sides(kMostPictureSide + 1, int(std::min<png_uint_32>(image.height, 1U << 30U)), name);
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  image.format = format;
  width = int(image.width);
  height = int(image.height);
  pixels.resize(PNG_IMAGE_SIZE(image));
  const png_color black = {0, 0, 0};
  if (png_image_finish_read(&image, &black, pixels.data(), 0, nullptr) == 0)
    return base::fail(fmt::format("{}: the PNG file is damaged or cut off: {}", name, image.message));
  return {};
}

/// Blue, green and red of cyan, magenta, yellow and black, each as what it leaves of white.
void take_left_colours(const std::vector<std::uint8_t>& left, std::vector<std::uint8_t>& bgr) {
  for (std::size_t i = 0; 4 * i < left.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      bgr[3 * i + c] = std::uint8_t((left[4 * i + 2 - c] * left[4 * i + 3] + 127) / 255);
}

base::Result<Frame> read_jpeg(std::string_view bytes, const std::string& name) {
  const OwnedJpeg jpeg(tjInitDecompress(), tjDestroy);
  if (!jpeg) return base::fail("there is not enough memory to read a JPEG file");
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  Frame frame;
  int subsampling = 0, colours = 0;
  const auto failed = [&](const char* what) {
    return base::fail(fmt::format("{}: {}: {}", name, what, tjGetErrorStr2(jpeg.get())));
  };
  if (tjDecompressHeader3(jpeg.get(), data, bytes.size(), &frame.width, &frame.height, &subsampling,
                          &colours) != 0)
    return failed("it is no whole JPEG file");
  if (frame.width < 1 || frame.height < 1) return failed("the JPEG file is damaged or cut off");
  if (const auto able = check_sides(frame.width, frame.height, name); !able)
    return tl::unexpected(able.error());
  frame.bgr.resize(3 * std::size_t(frame.width) * std::size_t(frame.height));
  const bool has_black = colours == TJCS_CMYK || colours == TJCS_YCCK;
  std::vector<std::uint8_t> printed(has_black ? frame.bgr.size() / 3 * 4 : 0);
  if (tjDecompress2(jpeg.get(), data, bytes.size(), has_black ? printed.data() : frame.bgr.data(),
                    frame.width, 0, frame.height, has_black ? TJPF_CMYK : TJPF_BGR, TJFLAG_LIMITSCANS) != 0)
    return failed("the JPEG file is damaged or cut off");
  if (has_black && !io::has_adobe_marker(bytes))
    for (std::uint8_t& value : printed) value = std::uint8_t(255 - value);
  take_left_colours(printed, frame.bgr);
  return frame;
}

}  // namespace

bool is_picture(std::string_view bytes) {
  return bytes.starts_with(kPngBegins) || bytes.starts_with(kJpegBegins);
}

base::Result<Frame> decode_picture(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kJpegBegins)) return read_jpeg(bytes, name);
  if (!bytes.starts_with(kPngBegins))
    return base::fail(fmt::format("{}: it is neither a PNG nor a JPEG file", name));
  Frame frame;
  if (const auto read = read_png(bytes, name, PNG_FORMAT_BGR, frame.bgr, frame.width, frame.height); !read)
    return tl::unexpected(read.error());
  return frame;
}

base::Result<charts::Image> decode_png_with_opacity(std::string_view bytes, const std::string& name) {
  charts::Image image;
  if (const auto read = read_png(bytes, name, PNG_FORMAT_RGBA, image.rgba, image.width, image.height); !read)
    return tl::unexpected(read.error());
  return image;
}

base::Result<std::string> encode_jpeg(const FrameView& frame, int quality) {
  const OwnedJpeg jpeg(tjInitCompress(), tjDestroy);
  if (!jpeg) return base::fail("there is not enough memory to make a JPEG file");
  unsigned char* made = nullptr;
  unsigned long size = 0;
  const int done = tjCompress2(jpeg.get(), frame.pixels, frame.width, int(frame.row_bytes), frame.height,
                               TJPF_BGR, &made, &size, TJSAMP_422, quality, 0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(made, tjFree);
  if (done != 0)
    return base::fail(fmt::format("the frame cannot be made a JPEG: {}", tjGetErrorStr2(jpeg.get())));
  return std::string(reinterpret_cast<const char*>(made), size);
}

base::Result<std::string> encode_png(const FrameView& frame) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(frame.width);
  image.height = static_cast<png_uint_32>(frame.height);
  image.format = PNG_FORMAT_BGR;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, frame.pixels,
                                static_cast<png_int_32>(frame.row_bytes), nullptr) == 0)
    return base::fail(fmt::format("the frame cannot be made a PNG: {}", image.message));
  bytes.resize(size);
  return bytes;
}

}  // namespace icome::cutout

#include "render/model/picture_decoder.h"

#include <fmt/format.h>
#include <gif_lib.h>
#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>

namespace icome::render {
namespace {

base::Result<charts::Image> blank_picture(long long width, long long height) {
  if (width < 1 || height < 1) return base::fail("the picture has no pixels");
  if (width > kMostPictureSide || height > kMostPictureSide || width * height > kMostPicturePixels) {
    return base::fail(
        fmt::format("the picture has {} x {} pixels, more than {} or a side longer than {}; make it smaller",
                    width, height, kMostPicturePixels, kMostPictureSide));
  }
  return charts::Image{int(width), int(height), std::vector<std::uint8_t>(std::size_t(4 * width * height))};
}

base::Result<charts::Image> decode_png(std::string_view bytes) {
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owned(&png, png_image_free);
  const auto damaged = [&] { return base::fail(fmt::format("the PNG picture is damaged: {}", png.message)); };
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return damaged();
  auto image = blank_picture(png.width, png.height);
  if (!image) return image;
  png.format = PNG_FORMAT_RGBA;
  if (!png_image_finish_read(&png, nullptr, image->rgba.data(), 0, nullptr)) return damaged();
  return image;
}

/// Printers' colours as JPEG files of Adobe's hold them: inverted.
void rgb_from_cmyk(std::vector<std::uint8_t>& pixels) {
  for (std::size_t i = 0; i + 3 < pixels.size(); i += 4) {
    const unsigned key = pixels[i + 3];
    for (std::size_t c = 0; c < 3; ++c) pixels[i + c] = std::uint8_t(pixels[i + c] * key / 255);
    pixels[i + 3] = 255;
  }
}

base::Result<charts::Image> decode_jpeg(std::string_view bytes) {
  const std::unique_ptr<void, decltype(&tjDestroy)> jpeg(tjInitDecompress(), tjDestroy);
  if (!jpeg) return base::fail("there is no memory for a JPEG picture");
  const auto damaged = [&] {
    return base::fail(fmt::format("the JPEG picture is damaged: {}", tjGetErrorStr2(jpeg.get())));
  };
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(jpeg.get(), data, bytes.size(), &width, &height, &subsampling, &colours) != 0)
    return damaged();
  auto image = blank_picture(width, height);
  if (!image) return image;
  const bool printed = colours == TJCS_CMYK || colours == TJCS_YCCK;
  // Thousands of scans would keep a processor busy for hours.
  const int done = tjDecompress2(jpeg.get(), data, bytes.size(), image->rgba.data(), width, 0, height,
                                 printed ? TJPF_CMYK : TJPF_RGBA, TJFLAG_LIMITSCANS);
  if (done != 0 && tjGetErrorCode(jpeg.get()) == TJERR_FATAL) return damaged();
  if (printed) rgb_from_cmyk(image->rgba);
  return image;
}

struct GifClose {
  void operator()(GifFileType* gif) const { DGifCloseFile(gif, nullptr); }
};
using Gif = std::unique_ptr<GifFileType, GifClose>;

int read_gif_bytes(GifFileType* gif, GifByteType* into, int count) {
  auto& left = *static_cast<std::string_view*>(gif->UserData);
  const std::size_t given = std::min(left.size(), std::size_t(std::max(count, 0)));
  std::memcpy(into, left.data(), given);
  left.remove_prefix(given);
  return int(given);
}

/// The index of the colour that is clear, from a graphics control extension.
std::optional<int> clear_colour(int code, const GifByteType* block) {
  if (code != GRAPHICS_EXT_FUNC_CODE || block == nullptr || block[0] < 4 || (block[1] & 1) == 0)
    return std::nullopt;
  return block[4];
}

/// Goes on to the first picture; false where there is none.
bool find_gif_picture(GifFileType* gif, std::optional<int>& clear) {
  GifRecordType record = UNDEFINED_RECORD_TYPE;
  while (DGifGetRecordType(gif, &record) == GIF_OK && record != TERMINATE_RECORD_TYPE) {
    if (record == IMAGE_DESC_RECORD_TYPE) return DGifGetImageDesc(gif) == GIF_OK;
    if (record != EXTENSION_RECORD_TYPE) continue;
    int code = 0;
    GifByteType* block = nullptr;
    int good = DGifGetExtension(gif, &code, &block);
    if (good == GIF_OK && code == GRAPHICS_EXT_FUNC_CODE) clear = clear_colour(code, block);
    while (good == GIF_OK && block != nullptr) good = DGifGetExtensionNext(gif, &block);
    if (good != GIF_OK) return false;
  }
  return false;
}

/// The rows of a picture in the order in which they come, which differs if it is interlaced.
std::vector<int> gif_rows(int height, bool interlaced) {
  std::vector<int> rows;
  constexpr std::array<std::array<int, 2>, 4> kWeaves = {{{0, 8}, {4, 8}, {2, 4}, {1, 2}}};
  for (const auto& [first, step] : kWeaves) {
    if (!interlaced) break;
    for (int y = first; y < height; y += step) rows.push_back(y);
  }
  for (int y = 0; !interlaced && y < height; ++y) rows.push_back(y);
  return rows;
}

base::Result<charts::Image> decode_gif(std::string_view bytes) {
  int error = 0;
  const Gif gif(DGifOpen(&bytes, read_gif_bytes, &error));
  const auto damaged = [](const char* why) {
    return base::fail(fmt::format("the GIF picture is damaged: {}", why ? why : "it ends too early"));
  };
  if (!gif) return damaged(GifErrorString(error));
  std::optional<int> clear;
  if (!find_gif_picture(gif.get(), clear)) return damaged("it holds no picture");
  const GifImageDesc& part = gif->Image;
  auto image = blank_picture(part.Width, part.Height);
  if (!image) return image;
  const ColorMapObject* colours = part.ColorMap ? part.ColorMap : gif->SColorMap;
  if (colours == nullptr) return damaged("it has no colours");
  std::vector<GifPixelType> line(std::size_t(part.Width));
  for (const int y : gif_rows(part.Height, part.Interlace)) {
    if (DGifGetLine(gif.get(), line.data(), part.Width) != GIF_OK) return damaged(GifErrorString(gif->Error));
    std::uint8_t* pixel = image->rgba.data() + 4 * std::size_t(y) * line.size();
    for (const GifPixelType index : line) {
      if (index < colours->ColorCount && index != clear) {
        const GifColorType& colour = colours->Colors[index];
        const std::array<std::uint8_t, 4> opaque = {colour.Red, colour.Green, colour.Blue, 255};
        std::memcpy(pixel, opaque.data(), 4);
      }
      pixel += 4;
    }
  }
  return image;
}

}  // namespace

base::Result<charts::Image> decode_picture(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG"sv)) return decode_png(bytes);
  if (bytes.starts_with("\xff\xd8"sv)) return decode_jpeg(bytes);
  if (bytes.starts_with("GIF8"sv)) return decode_gif(bytes);
  return base::fail("the picture is none of PNG, JPEG and GIF; convert it to one of these");
}

}  // namespace icome::render

#include "render/png.h"
#include "render/compare.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace render {
namespace {

namespace fs = std::filesystem;

void append(png_structp png, png_bytep data, png_size_t length) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), length);
}

void nothing_to_flush(png_structp) {}

bool ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
}

// libpng reports errors by longjmp: this function holds nothing that needs a destructor.
bool encode(const Image& image, png_textp texts, int text_count, png_bytepp rows, int filters, png_uint_32 per_metre,
            std::string* bytes) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, bytes, append, nothing_to_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 6);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
  if (per_metre > 0) png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
  png_set_text(png, info, texts, text_count);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::string png_bytes(const Image& image, const Provenance& facts, Content content, double dpi) {
  Provenance copy = facts;  // libpng wants mutable text
  std::vector<png_text> texts;
  for (auto& [key, value] : copy) {
    png_text text{};
    text.compression = ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = value.data();
    text.text_length = ascii(value) ? value.size() : 0;
    text.itxt_length = ascii(value) ? 0 : value.size();
    texts.push_back(text);
  }
  std::vector<png_bytep> rows;
  for (int row = 0; row < image.height; ++row) rows.push_back(const_cast<png_bytep>(&image.rgb[image.at(0, row)]));
  std::string bytes;
  const int filters = content == Content::drawing ? PNG_FILTER_NONE : PNG_ALL_FILTERS;
  if (!encode(image, texts.data(), static_cast<int>(texts.size()), rows.data(), filters,
              static_cast<png_uint_32>(std::lround(dpi / 0.0254)), &bytes))
    throw dem::EnvironmentError("cannot pack a picture as PNG");
  return bytes;
}

void write_png(const Image& image, const fs::path& path, const Provenance& facts, Content content, double dpi) {
  dem::write_file(path, png_bytes(image, facts, content, dpi));
}

Image read_png(const fs::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, path.c_str()) == 0)
    throw dem::EnvironmentError("cannot read " + path.string() + ": " + header.message);
  header.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) == 0)
    throw dem::EnvironmentError("cannot read " + path.string() + ": " + header.message);
  return image;
}

Provenance read_png_facts(const fs::path& path) {
  const std::string bytes = dem::read_file(path);
  Provenance facts;
  constexpr std::size_t signature = 8, frame = 12;  // a chunk: length, type, data, check sum
  for (std::size_t at = signature; at + frame <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = (length << 8) | static_cast<unsigned char>(bytes[at + i]);
    if (at + frame + length > bytes.size()) break;
    const std::string type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    const std::size_t end = data.find('\0');
    if (type == "tEXt" && end != std::string::npos) facts.emplace_back(data.substr(0, end), data.substr(end + 1));
    if (type == "iTXt" && end != std::string::npos) {  // key 0 flag method language 0 translated key 0 text
      const std::size_t language = data.find('\0', end + 3);
      const std::size_t translated = language == std::string::npos ? language : data.find('\0', language + 1);
      if (translated != std::string::npos) facts.emplace_back(data.substr(0, end), data.substr(translated + 1));
    }
    at += frame + length;
  }
  return facts;
}

ImageDifference compare_png(const fs::path& a, const fs::path& b) {
  const Image one = read_png(a), two = read_png(b);
  ImageDifference difference;
  difference.same_size = one.width == two.width && one.height == two.height;
  if (!difference.same_size) {
    difference.mean = difference.worst = 1;
    return difference;
  }
  double total = 0;
  constexpr int block = 8;
  for (int top = 0; top < one.height; top += block)
    for (int left = 0; left < one.width; left += block) {
      const int bottom = std::min(top + block, one.height), right = std::min(left + block, one.width);
      double sum[3] = {0, 0, 0};
      for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column)
          for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t i = one.at(column, row) + c;
            sum[c] += std::abs(static_cast<int>(one.rgb[i]) - static_cast<int>(two.rgb[i]));
          }
      const double count = 255.0 * (bottom - top) * (right - left);
      for (double s : sum) {
        total += s;
        difference.worst = std::max(difference.worst, s / count);
      }
    }
  if (!one.rgb.empty()) difference.mean = total / (255.0 * static_cast<double>(one.rgb.size()));
  return difference;
}

}  // namespace render

#pragma once
// PNG files with facts in text chunks. Same pixels and facts, same bytes.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/image.h"
#include "render/style.h"

namespace render {

enum class Content { photograph, drawing };  ///< shaded or flat colours: picks the row filter that packs better

/// Writes aside and renames; `dpi` tells how large the picture is in print, 0: not said. Throws dem::EnvironmentError.
void write_png(const Image& image, const std::filesystem::path& path, const Provenance& facts, Content content,
               double dpi = 0);

/// The bytes of such a file.
std::string png_bytes(const Image& image, const Provenance& facts, Content content, double dpi = 0);

/// Throws dem::EnvironmentError when the file is missing or no PNG.
Image read_png(const std::filesystem::path& path);

/// The text chunks of a PNG file, in their order.
Provenance read_png_facts(const std::filesystem::path& path);

}  // namespace render

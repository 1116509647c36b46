#pragma once
// Files inside the page, as links that need nothing beside it.
#include <filesystem>
#include <string>
#include <string_view>

namespace reports {

/// "data:text/csv;base64,..." of a file, its type told by its ending.
std::string data_uri(const std::filesystem::path& file);
/// The same of bytes for a file of this name.
std::string data_uri(std::string_view bytes, const std::filesystem::path& name);

}  // namespace reports

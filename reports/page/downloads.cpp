#include "reports/page/downloads.h"

#include <array>
#include <utility>

#include "engine/core/base64.h"
#include "engine/core/files.h"

namespace reports {

std::string data_uri(std::string_view bytes, const std::filesystem::path& name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> types{{{".png", "image/png"},
                                                                                {".svg", "image/svg+xml"},
                                                                                {".csv", "text/csv"},
                                                                                {".bib", "application/x-bibtex"},
                                                                                {".toml", "application/toml"}}};
  std::string_view type = "application/octet-stream";
  for (const auto& [ending, known] : types) {
    if (name.extension() == ending) type = known;
  }
  return "data:" + std::string(type) + ";base64," + dem::base64(std::string(bytes));
}

std::string data_uri(const std::filesystem::path& file) { return data_uri(dem::read_file(file), file); }

}  // namespace reports

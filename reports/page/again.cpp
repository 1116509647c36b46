#include "reports/page/again.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/files.h"
#include "reports/page/downloads.h"
#include "reports/page/listing.h"
#include "reports/text.h"

namespace reports {
namespace {

/// Words of a comment that no line holds are cut: to break one of 20,000 letters takes WeasyPrint minutes.
std::string with_short_words(std::string_view text) {
  constexpr std::size_t most = 300;
  std::string shown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n\t,"), text.size());
    std::size_t kept = std::min(end, most);
    while (kept < end && kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80)
      --kept;  // whole characters
    shown += text.substr(0, kept);
    if (kept < end) shown += fmt::format("... ({} bytes more)", end - kept);
    if (end < text.size()) shown += text[end];
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return shown;
}

std::string name_of(const std::filesystem::path& file, const InputFile& place) {
  return place.path.empty() ? file.filename().string() : place.path;
}

}  // namespace

PageData again_data(const dem::Scenario& scenario, const Again& again) {
  std::vector<std::string> saved;
  for (const auto& [file, place] :
       {std::pair{scenario.file(), again.scenario}, std::pair{scenario.included(), again.rock}}) {
    if (!place.shipped && std::filesystem::exists(file)) saved.push_back(name_of(file, place));
  }
  PageData data;
  data.set("command", again.command);
  data.set("has_saved", !saved.empty());
  data.set("saved", listed(saved));
  data.set("has_needs", !again.needs.empty());
  data.set("needs", again.needs);
  return data;
}

PageData sources_data(const dem::Scenario& scenario, const Again& again, bool printed) {
  constexpr std::size_t column = 41;  // characters
  PageData sources{PageData::type::list};
  for (const auto& [file, place] :
       {std::pair{scenario.file(), again.scenario}, std::pair{scenario.included(), again.rock}}) {
    if (!std::filesystem::exists(file)) continue;
    const std::string text = dem::read_file(file), name = name_of(file, place);
    PageData source;
    source.set("name", name);
    source.set("file", std::filesystem::path(name).filename().string());
    source.set("text", printed ? listing(with_short_words(text), column) : with_short_words(text));
    source.set("href", data_uri(text, "x.toml"));
    sources.push_back(source);
  }
  return sources;
}

}  // namespace reports

#include "reports/comparison/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/store/store.h"
#include "render/png.h"

namespace comparison {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int known_format = 2;  // of summary.json: the oldest that can be read

struct Amount {
  std::vector<double> numbers{};
  std::string words{};
};

Amount amount(const Json& json) {
  if (json.is_number()) return {{json.get<double>()}, {}};
  if (json.is_string()) return {{}, json.get<std::string>()};
  Amount all;
  if (json.is_array()) {
    for (const Json& item : json) all.numbers.push_back(item.get<double>());
  }
  return all;
}

struct QuantityName {
  std::string name, unit;
};

/// Of "cracks.intra_tension" the quantity of that id, or the family "cracks.*".
QuantityName quantity(const Json& quantities, const std::string& id) {
  if (const auto at = quantities.find(id); at != quantities.end())
    return {at->value("name", id), at->value("unit", "")};
  for (const auto& [key, value] : quantities.items()) {
    if (key.ends_with(".*") && id.starts_with(key.substr(0, key.size() - 1))) {
      return {value.value("name", id) + ", " + id.substr(key.size() - 1), value.value("unit", "")};
    }
  }
  return {id, {}};
}

/// Results nest at the dots of their ids.
void add_results(const Json& results, const Json& quantities, const std::string& id, const std::string& case_id,
                 std::vector<Fact>& facts) {
  for (const auto& [key, value] : results.items()) {
    const std::string whole = id.empty() ? key : id + "." + key;
    if (value.is_object()) {
      add_results(value, quantities, whole, case_id, facts);
      continue;
    }
    const QuantityName named = quantity(quantities, whole);
    const Amount found = amount(value);
    facts.push_back({FactKind::result, "results/" + case_id + "/" + whole, named.name + ", " + case_id, named.unit,
                     found.numbers, found.words});
  }
}

std::string content_of(const fs::path& folder, const std::string& id) {
  const fs::path path = folder / "cases" / id / "results.h5";
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  return dem::read_content(path);
}

void add_pictures(const Json& figures, const fs::path& folder, Snapshot& snapshot) {
  std::map<std::string, std::size_t> places;
  std::error_code error;
  for (const Json& figure : figures) {
    const std::string title = figure.value("title", "");
    for (const Json& named : figure.at("files")) {
      const fs::path file = named.get<std::string>();
      const std::string extension = file.extension().string();
      if (!fs::exists(folder / file, error)) {
        throw Unreadable(fmt::format("{} is named in summary.json and is not there", file.string()));
      }
      if (extension == ".csv") {
        snapshot.data.push_back({file.generic_string(), dem::sha256(dem::read_file(folder / file)), folder / file, {}});
      }
      if (extension != ".png" && extension != ".svg") continue;
      const std::string id = (file.parent_path() / file.stem()).generic_string();
      const auto [at, is_new] = places.try_emplace(id, snapshot.pictures.size());
      if (is_new) snapshot.pictures.push_back({.id = id, .title = title});
      Picture& picture = snapshot.pictures[at->second];
      if (extension == ".png") picture.png = folder / file;
      if (extension == ".svg") {
        picture.svg = folder / file;
        picture.drawing = dem::sha256(without_facts(dem::read_file(folder / file)));
      }
    }
  }
}

}  // namespace

bool is_report(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "summary.json", error);
}

Snapshot read_report(const fs::path& folder, const std::string& page) {
  if (!is_report(folder)) throw Unreadable("there is no summary.json: this study was not reported");
  Snapshot snapshot;
  try {
    const Json summary = Json::parse(dem::read_file(folder / "summary.json"));
    if (const int format = summary.at("format").get<int>(); format < known_format) {
      throw Unreadable(fmt::format("its summary.json is of format {}, older than {}: report it again with this program",
                                   format, known_format));
    }
    snapshot.scenario = summary.at("scenario").get<std::string>();
    snapshot.scale = summary.at("scale").get<std::string>();
    const Json quantities = summary.value("quantities", Json::object());
    for (const Json& one : summary.at("cases")) {
      StudyCase item{one.at("id").get<std::string>()};
      item.error = one.value("error", "");
      item.content = content_of(folder, item.id);
      add_results(one.at("results"), quantities, {}, item.id, snapshot.facts);
      snapshot.cases.push_back(std::move(item));
    }
    for (const Json& check : summary.at("checks")) {
      const auto id = check.at("id").get<std::string>();
      snapshot.facts.push_back({FactKind::check,
                                "checks/" + id,
                                "check " + id,
                                {},
                                amount(check.at("value")).numbers,
                                check.at("held").get<bool>() ? "held" : "broken"});
    }
    for (const Json& row : summary.at("comparisons")) {
      const auto id = row.at("id").get<std::string>();
      const Amount computed = amount(row.at("computed"));
      std::string words = row.value("verdict", "");
      if (!computed.words.empty()) words += ": " + computed.words;
      snapshot.facts.push_back({FactKind::published, "published/" + id, id + ", " + row.value("source", ""),
                                row.value("unit", ""), computed.numbers, words});
    }
    add_pictures(summary.at("figures"), folder, snapshot);
  } catch (const Json::exception& error) {
    throw Unreadable(std::string("its summary.json is cut short or damaged: ") + error.what());
  } catch (const dem::EnvironmentError& error) {
    throw Unreadable(error.what());
  }
  std::error_code error;
  if (!page.empty()) {
    snapshot.text = words_of(page);
  } else if (fs::exists(folder / "report.html", error)) {
    snapshot.text = words_of(dem::read_file(folder / "report.html"));
  }
  return snapshot;
}

std::vector<Curve> curves_of(const DataFile& file, Detail detail) {
  if (file.path.empty()) return file.reduced;
  std::vector<Curve> curves = curves_of_csv(dem::read_file(file.path));
  for (Curve& curve : curves) curve = reduced(curve, detail);
  return curves;
}

std::string pixels_of(const Picture& picture) {
  if (!picture.pixels.empty() || picture.png.empty()) return picture.pixels;
  try {
    const render::Image image = render::read_png(picture.png);
    const std::string_view bytes(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size());
    return dem::sha256(fmt::format("{} {}\n{}", image.width, image.height, bytes));
  } catch (const dem::EnvironmentError& error) {
    throw Unreadable(error.what());
  }
}

std::string without_facts(std::string svg) {
  const std::size_t from = svg.find("<metadata>");
  const std::size_t to = svg.find("</metadata>", from == std::string::npos ? 0 : from);
  if (from != std::string::npos && to != std::string::npos) svg.erase(from, to + 11 - from);
  return svg;
}

}  // namespace comparison

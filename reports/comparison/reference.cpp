#include "reports/comparison/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/append.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "render/png.h"
#include "reports/comparison/pictures.h"

namespace comparison {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_drawing = 8000;  // bytes of an SVG that is kept as it is
constexpr std::size_t largest_data = 40'000;      // bytes of the curves of a file
constexpr std::array factors = {2, 3, 4, 5, 6, 8, 10, 12};

/// The outer levels on lines of their own, what is inside on one: short, and a repository shows what changed.
void dump(const Json& json, int level, const std::string& indent, std::string& text) {
  if (level == 0 || !json.is_structured() || json.empty()) {
    text += json.dump();
    return;
  }
  text += json.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    text += std::string(first ? "" : ",") + "\n" + indent + " ";
    if (json.is_object()) text += Json(key).dump() + ": ";
    dump(value, level - 1, indent + " ", text);
    first = false;
  }
  text += "\n" + indent + (json.is_object() ? "}" : "]");
}

std::string text_of(const Json& json) {
  std::string text;
  dump(json, 3, "", text);
  return text + "\n";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// Lines that all cases have stand once.
Json cases_json(const std::vector<StudyCase>& cases) {
  std::vector<std::string> common;
  bool first = true;
  for (const StudyCase& one : cases) {
    if (one.content.empty()) continue;
    const std::vector<std::string> lines = lines_of(one.content);
    if (first) common = lines;
    first = false;
    const std::set<std::string> here(lines.begin(), lines.end());
    std::erase_if(common, [&](const std::string& line) { return !here.contains(line); });
  }
  const std::set<std::string> shared(common.begin(), common.end());
  Json json{{"common", common}, {"own", Json::object()}};
  for (const StudyCase& one : cases) {
    Json own = Json::object();
    if (!one.error.empty()) own["error"] = one.error;
    if (!one.content.empty()) {
      std::vector<std::string> lines = lines_of(one.content);
      std::erase_if(lines, [&](const std::string& line) { return shared.contains(line); });
      own["content"] = lines;
    }
    json["own"][one.id] = own;
  }
  return json;
}

std::vector<StudyCase> read_cases(const Json& json) {
  std::string common;
  for (const Json& line : json.at("common")) common += line.get<std::string>() + "\n";
  std::vector<StudyCase> cases;
  for (const auto& [id, own] : json.at("own").items()) {
    StudyCase one{id};
    one.error = own.value("error", "");
    if (own.contains("content")) {
      one.content = common;
      for (const Json& line : own.at("content")) one.content += line.get<std::string>() + "\n";
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

constexpr std::array<std::pair<FactKind, std::string_view>, 3> fact_ids = {
    {{FactKind::result, "results/"}, {FactKind::check, "checks/"}, {FactKind::published, "published/"}}};

/// The names of results and checks are those of the later report.
Json fact_json(const Fact& fact) {
  Json json{{"id", fact.id}};
  if (fact.kind == FactKind::published) json["name"] = fact.name;
  if (!fact.unit.empty()) json["unit"] = fact.unit;
  json["numbers"] = fact.numbers;
  if (!fact.words.empty()) json["words"] = fact.words;
  return json;
}

Fact read_fact(const Json& json) {
  const auto id = json.at("id").get<std::string>();
  const auto known = std::ranges::find_if(fact_ids, [&](const auto& one) { return id.starts_with(one.second); });
  if (known == fact_ids.end()) throw Unreadable("its reference.json has a number of an unknown kind: " + id);
  return {known->first,
          id,
          json.value("name", id),
          json.value("unit", ""),
          json.at("numbers").get<std::vector<double>>(),
          json.value("words", "")};
}

/// "0,0 0.5,12.25"
std::string points_text(const std::vector<std::pair<double, double>>& points) {
  std::string text;
  for (const auto& [x, y] : points) text += fmt::format("{}{:.9g},{:.9g}", text.empty() ? "" : " ", x, y);
  return text;
}

std::vector<std::pair<double, double>> read_points(std::string_view text) {
  std::vector<std::pair<double, double>> points;
  while (!text.empty()) {
    std::pair<double, double> point;
    for (double* value : {&point.first, &point.second}) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
      if (error != std::errc()) throw Unreadable("its reference.json has a curve that is no list of numbers");
      text.remove_prefix(std::min(static_cast<std::size_t>(end - text.data()) + 1, text.size()));
    }
    points.push_back(point);
  }
  return points;
}

Json data_json(const std::vector<DataFile>& data) {
  Json json = Json::object();
  for (const DataFile& file : data) {
    Json curves = Json::array();
    for (const Curve& curve : curves_of(file, Detail::reference)) {
      Json one = Json::object();
      if (!curve.key.empty()) one["key"] = curve.key;
      one["x"] = curve.x;
      one["y"] = curve.y;
      if (curve.within > 0) one["within"] = std::stod(fmt::format("{:.2g}", curve.within));
      one["points"] = points_text(curve.points);
      curves.push_back(std::move(one));
    }
    // Of a file with very many curves the hash has to do.
    if (curves.dump().size() > largest_data) curves = Json::array();
    json[file.file] = {{"sha256", file.sha256}, {"curves", std::move(curves)}};
  }
  return json;
}

std::vector<DataFile> read_data(const Json& json) {
  std::vector<DataFile> data;
  for (const auto& [name, file] : json.items()) {
    DataFile one{name, file.at("sha256").get<std::string>(), {}, {}};
    for (const Json& curve : file.at("curves")) {
      one.reduced.push_back({curve.value("key", ""), curve.value("x", ""), curve.value("y", ""),
                             read_points(curve.at("points").get<std::string>()), curve.value("within", 0.0)});
    }
    data.push_back(std::move(one));
  }
  return data;
}

/// What is kept of a picture: its entry, and the file with its bytes.
struct Kept {
  Json json;
  std::string file{}, bytes{};
};

Kept hashes(const Picture& picture) {
  Kept kept{{{"title", picture.title}}};
  if (const std::string pixels = pixels_of(picture); !pixels.empty()) kept.json["pixels"] = pixels;
  if (!picture.drawing.empty()) kept.json["drawing"] = picture.drawing;
  return kept;
}

Kept kept_picture(const Picture& picture, int factor) {
  Kept kept = hashes(picture);
  if (!picture.png.empty()) {
    const render::Image small = reduced_picture(render::read_png(picture.png), factor);
    kept.bytes = render::png_bytes(small, {}, render::Content::photograph);
    const std::string flat = render::png_bytes(small, {}, render::Content::drawing);
    if (flat.size() < kept.bytes.size()) kept.bytes = flat;
    kept.file = dem::sha256(kept.bytes).substr(0, 16) + ".png";
    kept.json["factor"] = factor;
  } else if (!picture.svg.empty()) {
    kept.bytes = without_facts(dem::read_file(picture.svg));
    if (kept.bytes.size() > largest_drawing) return hashes(picture);
    kept.file = dem::sha256(kept.bytes).substr(0, 16) + ".svg";
  }
  kept.json["file"] = kept.file;
  return kept;
}

std::uintmax_t bytes_of(const std::vector<Kept>& all) {
  std::map<std::string, std::size_t> files;
  for (const Kept& one : all) {
    if (!one.file.empty()) files[one.file] = one.bytes.size();
  }
  std::uintmax_t bytes = 0;
  for (const auto& [name, size] : files) bytes += size;
  return bytes;
}

/// As large as fits into `room`; the largest ones lose their copy when nothing does.
std::vector<Kept> kept_pictures(const std::vector<Picture>& pictures, std::uintmax_t room) {
  std::vector<Kept> kept;
  for (const int factor : factors) {
    kept.clear();
    for (const Picture& picture : pictures) kept.push_back(kept_picture(picture, factor));
    if (bytes_of(kept) <= room) return kept;
  }
  while (bytes_of(kept) > room) {
    const auto largest = std::ranges::max_element(kept, {}, [](const Kept& one) { return one.bytes.size(); });
    const auto at = static_cast<std::size_t>(largest - kept.begin());
    kept[at] = hashes(pictures[at]);
  }
  return kept;
}

std::vector<Picture> read_pictures(const Json& json, const fs::path& folder) {
  std::vector<Picture> pictures;
  for (const auto& [id, one] : json.items()) {
    Picture picture{.id = id, .title = one.value("title", "")};
    picture.pixels = one.value("pixels", "");
    picture.drawing = one.value("drawing", "");
    picture.factor = one.value("factor", 1);
    if (one.contains("file")) {
      const fs::path file = dem::inside(folder / "pictures", one.at("file").get<std::string>());
      std::error_code error;
      if (!fs::exists(file, error)) {
        throw Unreadable(fmt::format("it is not whole: pictures/{} is not there", file.filename().string()));
      }
      (file.extension() == ".svg" ? picture.svg : picture.png) = file;
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

/// `chosen` of the new snapshot, the rest of the old one. An item of both changes in its place.
template <class T, class Id>
void take(std::vector<T>& old, const std::vector<T>& now, const std::set<std::string>& chosen, Id id) {
  std::erase_if(old, [&](const T& one) {
    return chosen.contains(id(one)) && std::ranges::none_of(now, [&](const T& other) { return id(other) == id(one); });
  });
  for (const T& one : now) {
    if (!chosen.contains(id(one))) continue;
    const auto at = std::ranges::find_if(old, [&](const T& other) { return id(other) == id(one); });
    if (at == old.end()) {
      old.push_back(one);
    } else {
      *at = one;
    }
  }
}

Json picture_json_of_old(const Json& old, const std::string& id) { return old.at("pictures").at(id); }

std::string log_line(const std::string& study, const Acceptance& acceptance, const Accepted& accepted,
                     const std::string& hash) {
  // A study that is accepted as a whole can change in hundreds of places; the reference itself holds them all.
  constexpr std::size_t most = 30;
  Json items = Json::array();
  for (const Item& item : accepted.changed) {
    if (items.size() == most) {
      items.push_back({{"what", "others"}, {"difference", fmt::format("{} more", accepted.changed.size() - most)}});
      break;
    }
    Json one{{"what", item.id}};
    if (item.state != State::beyond) one["state"] = state_words(item.state);  // most are beyond tolerance
    if (!item.was.empty()) one["old"] = item.was;
    if (!item.is.empty()) one["new"] = item.is;
    if (!item.difference.empty()) one["difference"] = item.difference;
    items.push_back(std::move(one));
  }
  return Json{{"date", acceptance.date},           {"study", study},           {"reason", acceptance.reason},
              {"whole", acceptance.items.empty()}, {"first", accepted.is_new}, {"reference", hash},
              {"items", std::move(items)}}
      .dump();
}

/// What an acceptance that was killed left to do: the line of one that took place, which the log lacks. The lock is held.
void finish_acceptances(const fs::path& references, dem::FileLock& log) {
  std::error_code error;
  for (fs::directory_iterator at(references, error), end; !error && at != end; at.increment(error)) {
    const fs::path journal = at->path() / "accepting.json";
    std::error_code ignored;
    if (!fs::exists(journal, ignored)) continue;
    const std::string line = dem::read_file(journal);
    const std::string lines = dem::read_file(references / "accepted.jsonl");
    const fs::path reference = at->path() / "reference.json";
    const bool took_place =
        fs::exists(reference, ignored) &&
        line.find("\"reference\":\"" + dem::sha256(dem::read_file(reference)) + "\"") != std::string::npos;
    if (took_place && lines.find(line) == std::string::npos) log.append(line);
    fs::remove(journal, ignored);
  }
}

void remove_unused(const fs::path& folder, const Json& pictures) {
  std::set<std::string> used;
  for (const Json& one : pictures) {
    if (one.contains("file")) used.insert(one.at("file").get<std::string>());
  }
  dem::remove_leftovers(folder);
  dem::remove_leftovers(folder / "pictures");
  std::error_code error;
  std::vector<fs::path> unused;
  for (fs::directory_iterator at(folder / "pictures", error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with('.') && !used.contains(name)) unused.push_back(at->path());
  }
  for (const fs::path& path : unused) fs::remove(path, error);
}

std::uintmax_t size_of(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored)) bytes += at->file_size(ignored);
  }
  return bytes;
}

}  // namespace

std::uintmax_t most_bytes(const std::string& scale) { return scale == "smoke" ? 330'000 : 1'500'000; }

bool is_reference(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "reference.json", error);
}

Snapshot read_reference(const fs::path& folder) {
  if (!is_reference(folder)) throw Unreadable("there is no reference.json in it");
  Snapshot snapshot;
  snapshot.reduced = true;
  try {
    const Json json = Json::parse(dem::read_file(folder / "reference.json"));
    const int format = json.at("format").get<int>();
    if (format != reference_format) {
      throw Unreadable(
          fmt::format("its format is {}, and this program reads {}: look at the report, then accept it anew", format,
                      reference_format));
    }
    snapshot.scenario = json.at("scenario").get<std::string>();
    snapshot.scale = json.at("scale").get<std::string>();
    snapshot.cases = read_cases(json.at("cases"));
    for (const Json& fact : json.at("facts")) snapshot.facts.push_back(read_fact(fact));
    snapshot.data = read_data(json.at("data"));
    snapshot.pictures = read_pictures(json.at("pictures"), folder);
    for (const auto& [section, lines] : json.at("text").items()) {
      snapshot.text.push_back({section, lines.get<std::vector<std::string>>()});
    }
  } catch (const Json::exception& error) {
    throw Unreadable(std::string("its reference.json is cut short or damaged: ") + error.what());
  } catch (const dem::EnvironmentError& error) {
    throw Unreadable(error.what());
  }
  return snapshot;
}

Snapshot read_either(const fs::path& folder) {
  return is_reference(folder) ? read_reference(folder) : read_report(folder);
}

Accepted accept(const fs::path& folder, const fs::path& references, const Acceptance& acceptance,
                const Options& options) {
  Snapshot report = read_report(folder);
  const std::string name = report.name();
  const fs::path place = dem::inside(references, name);
  dem::FileLock log(references / "accepted.jsonl");
  finish_acceptances(references, log);

  Accepted accepted;
  accepted.is_new = !is_reference(place);
  std::optional<Snapshot> old;
  Json old_json;
  if (!accepted.is_new) {
    try {
      old = read_reference(place);
      old_json = Json::parse(dem::read_file(place / "reference.json"));
    } catch (const Unreadable&) {
      if (!acceptance.items.empty()) throw;  // of the whole study nothing old is needed
    }
  }
  const bool whole = acceptance.items.empty();
  if (!whole && !old) {
    throw dem::InputError("there is no reference of " + name + " yet", "accept the whole study first, without --item");
  }
  std::set<std::string> chosen;
  if (old) {
    for (Item& item : compare(*old, report, options).items) {
      const bool meant = whole || std::ranges::any_of(acceptance.items, [&](const std::string& pattern) {
                           return fits_pattern(pattern, item.id);
                         });
      if (!meant) continue;
      chosen.insert(item.id);
      item.pictures.clear();
      item.overlays.clear();
      if (item.state != State::same) accepted.changed.push_back(std::move(item));
    }
    for (const std::string& pattern : acceptance.items) {
      if (std::ranges::none_of(chosen, [&](const std::string& id) { return fits_pattern(pattern, id); })) {
        throw dem::InputError({}, "--item", "nothing in " + name + " is called '" + pattern + "'",
                              "the names stand in comparison.json, and in the table of the page: results/CASE/RESULT, "
                              "figures/FIGURE, data/FILE.csv; * stands for anything");
      }
    }
  }
  Snapshot now = report;
  if (!whole) {
    now = *old;
    take(now.cases, report.cases, chosen, [](const StudyCase& one) { return "cases/" + one.id; });
    take(now.facts, report.facts, chosen, [](const Fact& one) { return one.id; });
    take(now.data, report.data, chosen, [](const DataFile& one) { return one.file; });
    take(now.pictures, report.pictures, chosen, [](const Picture& one) { return one.id; });
    take(now.text, report.text, chosen, [](const Passage& one) { return "text/" + one.section; });
  }

  Json json{{"format", reference_format},     {"scenario", now.scenario}, {"scale", now.scale},
            {"cases", cases_json(now.cases)}, {"facts", Json::array()},   {"data", data_json(now.data)},
            {"pictures", Json::object()},     {"text", Json::object()}};
  for (const Fact& fact : now.facts) json["facts"].push_back(fact_json(fact));
  for (const Passage& passage : now.text) json["text"][passage.section] = passage.lines;
  // Pictures that stay keep the copy that there is; the others share the room that is left.
  std::vector<Picture> fresh;
  std::uintmax_t taken = text_of(json).size() + 200 * now.pictures.size();
  for (const Picture& picture : now.pictures) {
    const bool stays = !whole && !chosen.contains(picture.id);
    if (!stays) {
      fresh.push_back(picture);
    } else if (const fs::path& file = picture.png.empty() ? picture.svg : picture.png; !file.empty()) {
      taken += fs::file_size(file);
    }
  }
  const std::uintmax_t most = most_bytes(now.scale);
  const std::vector<Kept> kept = kept_pictures(fresh, most > taken ? most - taken : 0);
  std::size_t next = 0;
  for (const Picture& picture : now.pictures) {
    const bool stays = !whole && !chosen.contains(picture.id);
    json["pictures"][picture.id] = stays ? picture_json_of_old(old_json, picture.id) : kept[next++].json;
  }
  for (const Kept& one : kept) {
    if (one.file.empty()) ++accepted.without_picture;
    std::error_code error;
    if (!one.file.empty() && !fs::exists(place / "pictures" / one.file, error)) {
      dem::write_file(place / "pictures" / one.file, one.bytes);
    }
  }
  const std::string text = text_of(json);
  const std::string line = log_line(name, acceptance, accepted, dem::sha256(text));
  dem::write_file(place / "accepting.json", line);
  dem::write_file(place / "reference.json", text);  // here it is accepted
  log.append(line);
  std::error_code ignored;
  fs::remove(place / "accepting.json", ignored);
  remove_unused(place, json["pictures"]);
  accepted.bytes = size_of(place);
  return accepted;
}

}  // namespace comparison

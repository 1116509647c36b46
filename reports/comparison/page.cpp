#include "reports/comparison/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "engine/core/base64.h"
#include "engine/core/files.h"
#include "engine/scenario/units.h"
#include "reports/template.h"
#include "reports/text.h"

namespace comparison {
namespace {

using Data = reports::PageData;
using Json = nlohmann::ordered_json;

constexpr std::array kinds = {Kind::study_case, Kind::result,  Kind::check, Kind::published,
                              Kind::curve,      Kind::picture, Kind::text};
constexpr std::array states = {State::same, State::within_tolerance, State::within_scatter, State::beyond, State::came,
                               State::gone};
constexpr std::size_t most_picture_bytes = 24'000'000;  // of a page
constexpr std::size_t most_lines = 40;                  // of text or keys of one item

std::string state_id(State state) {
  std::string id(state_words(state));
  std::ranges::replace(id, ' ', '_');
  return id;
}

std::string kind_id(Kind kind) {
  std::string id(kind_words(kind));
  std::ranges::replace(id, ' ', '_');
  return id;
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    all += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return all;
}

std::string points_text(const std::vector<std::pair<double, double>>& points, const double (&low)[2],
                        const double (&scale)[2]) {
  std::string text;
  for (const auto& [x, y] : points) {
    text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ", 84 + 368 * (x - low[0]) / scale[0],
                        174 - 160 * (y - low[1]) / scale[1]);
  }
  return text;
}

std::string name_of(const Curve& curve) { return (curve.key.empty() ? "" : curve.key + ": ") + curve.y; }

/// Old and new over each other.
std::string overlay_svg(const Overlay& overlay) {
  double low[2] = {0, 0}, high[2] = {0, 0};
  bool first = true;
  for (const auto* points : {&overlay.was.points, &overlay.is.points}) {
    for (const auto& [x, y] : *points) {
      const double values[2] = {x, y};
      for (int k = 0; k < 2; ++k) {
        low[k] = first ? values[k] : std::min(low[k], values[k]);
        high[k] = first ? values[k] : std::max(high[k], values[k]);
      }
      first = false;
    }
  }
  double scale[2];
  for (int k = 0; k < 2; ++k) scale[k] = high[k] > low[k] ? high[k] - low[k] : 1;
  const auto curve = [&](const Curve& one, const char* name) {
    std::string text;
    if (one.points.size() > 1) {
      text += fmt::format("<polyline class=\"{}\" points=\"{}\"/>", name, points_text(one.points, low, scale));
    }
    if (one.points.size() > 16) return text;
    for (const auto& point : one.points) {
      const std::string at = points_text({point}, low, scale);
      const std::size_t comma = at.find(',');
      text += fmt::format("<circle class=\"{} dot\" cx=\"{}\" cy=\"{}\" r=\"3\"/>", name, at.substr(0, comma),
                          at.substr(comma + 1));
    }
    return text;
  };
  const std::string title = escaped(name_of(overlay.is));
  return fmt::format(
      "<svg viewBox=\"0 0 460 206\" role=\"img\" aria-label=\"{}, old and new; they differ by {} of the range at "
      "most\">"
      "<path class=\"frame\" d=\"M84 10V174H456\"/>{}{}"
      "<text x=\"80\" y=\"18\" text-anchor=\"end\">{}</text><text x=\"80\" y=\"174\" text-anchor=\"end\">{}</text>"
      "<text x=\"84\" y=\"188\">{}</text><text x=\"456\" y=\"188\" text-anchor=\"end\">{}</text>"
      "<text x=\"270\" y=\"202\" text-anchor=\"middle\">{}</text></svg>",
      title, reports::percent(overlay.distance, overlay.distance < 0.001 ? 4 : 2), curve(overlay.was, "was"),
      curve(overlay.is, "is"), reports::number(high[1], 3), reports::number(low[1], 3), reports::number(low[0], 3),
      reports::number(high[0], 3), escaped(overlay.is.x));
}

void set(Data& data, const std::string& name, const std::string& text) {
  data.set(name, text);
  data.set("has_" + name, Data{text.empty() ? Data::type::bool_false : Data::type::bool_true});
}

void flag(Data& data, const std::string& name, bool value) {
  data.set(name, Data{value ? Data::type::bool_true : Data::type::bool_false});
}

/// An id that may be broken where a reader would.
std::string breakable(const std::string& id) {
  std::string all;
  for (const char c : id) {
    all += escaped(std::string(1, c));
    if (c == '/' || c == '_' || c == '.') all += "<wbr>";
  }
  return all;
}

/// A cell of a table: there is nothing to draw.
bool is_one_point(const Overlay& overlay) { return overlay.was.points.size() == 1 && overlay.is.points.size() == 1; }

std::string cell_text(const Overlay& overlay) {
  const double was = overlay.was.points[0].second, is = overlay.is.points[0].second;
  for (const int digits : {4, 7}) {
    const std::string a = reports::number(was, digits), b = reports::number(is, digits);
    if (a != b) return name_of(overlay.is) + ": " + a + " → " + b;
  }
  return name_of(overlay.is) + ": " + dem::shortest(was) + " → " + dem::shortest(is);
}

Data item_data(const Item& item, std::size_t& room) {
  Data data;
  set(data, "id", item.id);
  data.set("id_html", breakable(item.id));
  set(data, "name", item.name == item.id ? "" : item.name);
  data.set("state", std::string(state_words(item.state)));
  data.set("state_class", item.alarms() ? "bad" : "good");
  set(data, "was", item.was);
  set(data, "is", item.is);
  set(data, "difference", item.difference);
  set(data, "tolerance", item.tolerance);
  std::vector<std::string> all_lines = item.lines;
  std::vector<const Overlay*> drawn;
  for (const Overlay& overlay : item.overlays) {
    if (is_one_point(overlay)) {
      all_lines.push_back(cell_text(overlay));
    } else {
      drawn.push_back(&overlay);
    }
  }
  Data lines{Data::type::list};
  for (std::size_t i = 0; i < std::min(all_lines.size(), most_lines); ++i) {
    Data line;
    const std::string& text = all_lines[i];
    line.set("line", text);
    line.set("line_class", text.starts_with("- ") ? "old" : text.starts_with("+ ") ? "new" : "key");
    lines.push_back(line);
  }
  if (all_lines.size() > most_lines) {
    Data line;
    line.set("line", fmt::format("and {} more", all_lines.size() - most_lines));
    line.set("line_class", "key");
    lines.push_back(line);
  }
  data.set("lines", lines);
  flag(data, "has_lines", !all_lines.empty());
  Data overlays{Data::type::list};
  for (const Overlay* overlay : drawn) {
    Data one;
    one.set("svg", overlay_svg(*overlay));
    one.set("caption", name_of(overlay->is));
    one.set("apart", reports::percent(overlay->distance, overlay->distance < 0.001 ? 4 : 2));
    overlays.push_back(one);
  }
  data.set("overlays", overlays);
  flag(data, "has_overlays", !drawn.empty());
  std::size_t bytes = 0;
  for (const Shown& shown : item.pictures) bytes += shown.bytes.size();
  const bool fits = bytes <= room;
  Data pictures{Data::type::list};
  if (fits) {
    room -= bytes;
    for (const Shown& shown : item.pictures) {
      Data one;
      one.set("label", shown.label);
      one.set("alt", item.id + ": " + shown.label);
      one.set("image", "data:" + shown.mime + ";base64," + dem::base64(shown.bytes));
      pictures.push_back(one);
    }
  }
  data.set("pictures", pictures);
  flag(data, "has_pictures", fits && !item.pictures.empty());
  flag(data, "no_room", !fits);
  return data;
}

Data causes_data(const StudyComparison& study) {
  Data causes{Data::type::list};
  for (const Cause& cause : study.causes) {
    Data one;
    one.set("cause", cause.text);
    set(one, "in_cases",
        cause.cases.size() > 6 ? fmt::format("{} cases", cause.cases.size()) : reports::listed(cause.cases));
    causes.push_back(one);
  }
  return causes;
}

/// What was counted, a row a kind.
Data counts_data(const StudyComparison& study) {
  Data rows{Data::type::list};
  for (const Kind kind : kinds) {
    Data row, cells{Data::type::list};
    std::size_t all = 0;
    for (const State state : states) {
      const std::size_t count = study.count(kind, state);
      all += count;
      Data cell;
      cell.set("count", std::to_string(count));
      cell.set("count_class", count == 0                                                               ? "none"
                              : state == State::beyond || state == State::came || state == State::gone ? "bad"
                                                                                                       : "good");
      cells.push_back(cell);
    }
    if (all == 0) continue;
    row.set("kind", std::string(kind_words(kind)));
    row.set("cells", cells);
    rows.push_back(row);
  }
  return rows;
}

Data study_data(const StudyComparison& study, std::size_t& room) {
  Data data;
  data.set("study", study.name);
  data.set("sentence", study.sentence());
  data.set("study_class", study.well() ? "good" : "bad");
  set(data, "problem", study.problem);
  flag(data, "is_new", study.is_new);
  flag(data, "is_gone", study.is_gone);
  const Data causes = causes_data(study);
  data.set("causes", causes);
  flag(data, "has_causes", !study.causes.empty());
  data.set("counts", counts_data(study));
  flag(data, "has_counts", !study.items.empty());
  Data groups{Data::type::list}, allowed{Data::type::list};
  bool any_allowed = false;
  for (const Kind kind : kinds) {
    Data group, items{Data::type::list};
    bool any = false;
    for (const Item& item : study.items) {
      if (item.kind != kind || item.state == State::same) continue;
      if (!item.alarms()) {
        allowed.push_back(item_data(item, room));
        any_allowed = true;
        continue;
      }
      items.push_back(item_data(item, room));
      any = true;
    }
    if (!any) continue;
    group.set("kind", std::string(kind_words(kind)));
    const bool numbers = kind == Kind::result || kind == Kind::check || kind == Kind::published;
    flag(group, "numbers", numbers);
    flag(group, "others", !numbers);
    group.set("items", items);
    groups.push_back(group);
  }
  data.set("groups", groups);
  data.set("allowed", allowed);
  flag(data, "has_allowed", any_allowed);
  return data;
}

Json item_json(const Item& item) {
  Json json{{"id", item.id}, {"state", state_id(item.state)}};
  const auto put = [&](const char* name, const std::string& text) {
    if (!text.empty()) json[name] = text;
  };
  put("name", item.name);
  put("old", item.was);
  put("new", item.is);
  put("difference", item.difference);
  put("tolerance", item.tolerance);
  if (item.turned) json["turned"] = true;
  if (!item.lines.empty()) json["lines"] = item.lines;
  return json;
}

}  // namespace

bool Comparison::well() const { return std::ranges::all_of(studies, &StudyComparison::well); }

std::string comparison_page(const Comparison& comparison, const std::filesystem::path& assets) {
  Data data, studies{Data::type::list};
  std::size_t room = most_picture_bytes;
  const auto bad = static_cast<std::size_t>(
      std::ranges::count_if(comparison.studies, [](const StudyComparison& one) { return !one.well(); }));
  for (const bool well : {false, true}) {  // what needs eyes comes first
    for (const StudyComparison& study : comparison.studies) {
      if (study.well() == well) studies.push_back(study_data(study, room));
    }
  }
  data.set("style", dem::read_file(assets / "page" / "night.css"));
  data.set("verdict_class", bad == 0 ? "good" : "bad");
  const std::size_t all = comparison.studies.size();
  data.set("verdict", bad > 0    ? fmt::format("{} of {} {} changed", bad, all, all == 1 ? "study" : "studies")
                      : all == 1 ? comparison.studies[0].sentence()
                                 : fmt::format("{} studies: nothing changed beyond tolerance", all));
  data.set("studies", studies);
  return reports::fill_template(assets / "page" / "comparison.html", std::move(data));
}

std::string since_section(const StudyComparison& study, const std::string& page, const std::filesystem::path& assets) {
  std::size_t room = 0;  // pictures are on the page of the comparison
  Data data = study_data(study, room);
  Data rows{Data::type::list};
  std::size_t shown = 0;
  constexpr std::size_t most = 25;
  for (const Item& item : study.items) {
    if (!item.alarms() || ++shown > most) continue;
    rows.push_back(item_data(item, room));
  }
  data.set("rows", rows);
  flag(data, "has_rows", shown > 0);
  set(data, "more", shown > most ? fmt::format("and {} more", shown - most) : "");
  set(data, "page", page);
  return reports::fill_template(assets / "page" / "since.html", std::move(data));
}

std::string comparison_json(const Comparison& comparison) {
  Json json{{"format", 1}, {"same", comparison.well()}, {"studies", Json::array()}};
  for (const StudyComparison& study : comparison.studies) {
    Json one{{"study", study.name},
             {"state", !study.problem.empty() ? "unreadable"
                       : study.is_new         ? "new"
                       : study.is_gone        ? "gone"
                       : study.well()         ? "same"
                                              : "changed"},
             {"sentence", study.sentence()},
             {"causes", Json::array()},
             {"counts", Json::object()},
             {"changed", Json::array()},
             {"same", Json::array()}};
    if (!study.problem.empty()) one["problem"] = study.problem;
    for (const Cause& cause : study.causes) one["causes"].push_back({{"cause", cause.text}, {"cases", cause.cases}});
    for (const Kind kind : kinds) {
      for (const State state : states) {
        if (const std::size_t count = study.count(kind, state); count > 0)
          one["counts"][kind_id(kind)][state_id(state)] = count;
      }
    }
    for (const Item& item : study.items) {
      if (item.state == State::same) {
        one["same"].push_back(item.id);
      } else {
        one["changed"].push_back(item_json(item));
      }
    }
    json["studies"].push_back(std::move(one));
  }
  return json.dump(1) + "\n";
}

}  // namespace comparison

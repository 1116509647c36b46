#include "reports/comparison/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "engine/analysis/fits.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/scenario/changes.h"
#include "engine/scenario/units.h"
#include "render/png.h"
#include "reports/comparison/pictures.h"
#include "reports/text.h"

namespace comparison {
namespace {

std::string line_of(const std::string& content, std::string_view key) {
  const std::string head = std::string(key) + " = ";
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    if (content.compare(at, head.size(), head) == 0) return content.substr(at + head.size(), end - at - head.size());
    at = end + 1;
  }
  return {};
}

template <class Items>
auto* find(Items& items, const std::string& id) {
  const auto at = std::ranges::find(items, id, [](const auto& item) -> const std::string& { return item.id; });
  return at == items.end() ? nullptr : &*at;
}

/// How many doubles lie between two: 1 is the last bit.
std::uint64_t units_apart(double a, double b) {
  const auto ordered = [](double value) {
    const auto bits = std::bit_cast<std::int64_t>(value);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
  };
  const std::int64_t x = ordered(a), y = ordered(b);
  return x > y ? static_cast<std::uint64_t>(x) - static_cast<std::uint64_t>(y)
               : static_cast<std::uint64_t>(y) - static_cast<std::uint64_t>(x);
}

/// `same_input`: then rounding is what tells two numbers so near each other apart.
std::string change_text(double was, double is, bool same_input) {
  const std::uint64_t units = units_apart(was, is);
  if (units <= 64) {
    return fmt::format("{} unit{} in the last place{}", units, units == 1 ? "" : "s",
                       same_input ? ": other rounding, as by another compiler or flag" : "");
  }
  if (was == 0) return reports::with_sign(reports::number(is - was, 3));
  const double relative = (is - was) / std::abs(was);
  return reports::with_sign(reports::number(100 * relative, 3)) + " %";
}

/// Digits enough to tell them apart.
std::pair<std::string, std::string> numbers_text(double was, double is, const std::string& unit) {
  const std::string tail = unit.empty() ? "" : " " + unit;
  for (const int digits : {4, 7}) {
    const std::string a = reports::number(was, digits), b = reports::number(is, digits);
    if (a != b) return {a + tail, b + tail};
  }
  return {dem::shortest(was) + tail, dem::shortest(is) + tail};
}

std::string one_number(const Fact& fact) {
  std::string text;
  for (const double value : fact.numbers) text += (text.empty() ? "" : " to ") + reports::number(value, 4);
  if (!text.empty() && !fact.unit.empty()) text += " " + fact.unit;
  if (!fact.words.empty()) text += (text.empty() ? "" : ", ") + fact.words;
  return text;
}

using Point = std::pair<double, double>;

double to_line(const Point& p, const std::vector<Point>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point& a = line[i];
    const Point& b = line[std::min(i + 1, line.size() - 1)];
    const double bx = b.first - a.first, by = b.second - a.second;
    const double px = p.first - a.first, py = p.second - a.second;
    const double length = bx * bx + by * by;
    const double at = length > 0 ? std::clamp((px * bx + py * by) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(px - at * bx, py - at * by));
  }
  return least;
}

class Comparer {
 public:
  Comparer(const Snapshot& was, const Snapshot& is, const Options& options) : was_(was), is_(is), options_(options) {}

  StudyComparison compare() {
    result_.name = is_.name();
    compare_cases();
    compare_facts();
    compare_data();
    compare_pictures_of_study();
    compare_text();
    explain();
    return std::move(result_);
  }

 private:
  Item& add(Kind kind, const std::string& id, const std::string& name) {
    result_.items.push_back({.kind = kind, .id = id, .name = name});
    return result_.items.back();
  }

  void compare_cases() {
    std::map<std::string, std::size_t> causes;
    for (const StudyCase& now : is_.cases) {
      Item& item = add(Kind::study_case, "cases/" + now.id, now.id);
      const StudyCase* before = find(was_.cases, now.id);
      if (!before) {
        item.state = State::came;
        item.is = now.error.empty() ? "simulated" : now.error;
        continue;
      }
      if (before->error != now.error) {
        item.state = State::beyond;
        item.turned = true;
        item.was = before->error.empty() ? "simulated" : before->error;
        item.is = now.error.empty() ? "simulated" : now.error;
      }
      const std::string model = line_of(now.content, "model");
      const auto known = std::ranges::find(options_.models, model, &dem::Model::name);
      const auto keys = known == options_.models.end() ? std::span<const dem::Key>() : known->keys();
      item.lines = dem::changed_lines(before->content, now.content, keys);
      if (before->content.empty() || now.content.empty()) item.lines.clear();
      if (!item.lines.empty()) {
        item.state = State::beyond;
        item.difference = fmt::format("{} key{} changed", item.lines.size(), item.lines.size() == 1 ? "" : "s");
        item.tolerance = "none (input)";
        other_input_.insert(now.id);
      }
      for (const std::string& line : item.lines) {
        const auto [at, is_new] = causes.try_emplace(line, result_.causes.size());
        if (is_new) result_.causes.push_back({line, {}});
        result_.causes[at->second].cases.push_back(now.id);
      }
      const std::string physics = line_of(before->content, "physics version");
      if (!physics.empty() && physics != line_of(now.content, "physics version")) other_physics_.insert(now.id);
    }
    for (const StudyCase& before : was_.cases) {
      if (find(is_.cases, before.id)) continue;
      Item& item = add(Kind::study_case, "cases/" + before.id, before.id);
      item.state = State::gone;
      item.was = before.error.empty() ? "simulated" : before.error;
    }
    for (Cause& cause : result_.causes) {
      if (cause.cases.size() == is_.cases.size()) cause.cases.clear();
    }
  }

  /// "results/CASE/ID", "checks/CASE.ID" -> CASE; "" for published numbers.
  [[nodiscard]] std::string case_of(const Fact& fact) const {
    const std::string rest = fact.id.substr(fact.id.find('/') + 1);
    if (fact.kind == FactKind::published) return {};
    return rest.substr(0, rest.find(fact.kind == FactKind::result ? '/' : '.'));
  }

  /// Half the width in which 95 % of the differences of two seeds lie, from the cases that differ in the seed alone; none
  /// when there are fewer than three.
  [[nodiscard]] std::optional<std::pair<double, std::size_t>> scatter(const Fact& fact) const {
    if (fact.kind != FactKind::result) return {};
    const std::string id = case_of(fact);
    const StudyCase* self = find(was_.cases, id);
    if (!self) return {};
    const std::string like = without_seed(self->content);
    const std::string tail = fact.id.substr(("results/" + id).size());
    std::vector<double> values;
    for (const StudyCase& other : was_.cases) {
      if (other.content.empty() || without_seed(other.content) != like) continue;
      const Fact* there = find(was_.facts, "results/" + other.id + tail);
      if (there && there->numbers.size() == 1) values.push_back(there->numbers[0]);
    }
    if (values.size() < 3) return {};
    double mean = 0, square = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) square += (value - mean) * (value - mean);
    const double deviation = std::sqrt(square / static_cast<double>(values.size() - 1));
    return std::pair{
        dem::analysis::student_limit(0.05, static_cast<double>(values.size() - 1)) * std::sqrt(2.0) * deviation,
        values.size()};
  }

  static std::string without_seed(const std::string& content) {
    const std::size_t at = content.find("\nseed = ");
    if (at == std::string::npos) return content;
    return content.substr(0, at) + content.substr(std::min(content.find('\n', at + 1), content.size()));
  }

  void compare_facts() {
    for (const Fact& now : is_.facts) {
      const Kind kind = now.kind == FactKind::result  ? Kind::result
                        : now.kind == FactKind::check ? Kind::check
                                                      : Kind::published;
      Item& item = add(kind, now.id, now.name);
      const Fact* before = find(was_.facts, now.id);
      if (!before) {
        item.state = State::came;
        item.is = one_number(now);
      } else {
        compare_fact(*before, now, item);
      }
    }
    for (const Fact& before : was_.facts) {
      if (find(is_.facts, before.id)) continue;
      const Kind kind = before.kind == FactKind::result  ? Kind::result
                        : before.kind == FactKind::check ? Kind::check
                                                         : Kind::published;
      Item& item = add(kind, before.id, before.name);
      item.state = State::gone;
      item.was = one_number(before);
    }
  }

  void compare_fact(const Fact& before, const Fact& now, Item& item) {
    item.turned = before.words != now.words;
    const auto same_number = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || a == b;
    };
    const bool same_numbers = std::ranges::equal(before.numbers, now.numbers, same_number);
    item.moved = !same_numbers;
    if (same_numbers && !item.turned && before.unit == now.unit) {
      item.was = item.is = one_number(now);
      return;
    }
    item.was = one_number(before);
    item.is = one_number(now);
    item.state = State::beyond;
    if (before.unit != now.unit) {
      item.difference = "another unit";
      return;
    }
    if (!same_numbers && before.numbers.size() == now.numbers.size()) {
      std::size_t worst = 0;
      for (std::size_t i = 0; i < now.numbers.size(); ++i) {
        if (std::abs(now.numbers[i] - before.numbers[i]) > std::abs(now.numbers[worst] - before.numbers[worst]))
          worst = i;
      }
      const std::string id = case_of(now);
      const bool same_input = id.empty() ? other_input_.empty() : !other_input_.contains(id);
      item.difference = change_text(before.numbers[worst], now.numbers[worst], same_input);
      if (now.numbers.size() == 1) {
        std::tie(item.was, item.is) = numbers_text(before.numbers[0], now.numbers[0], now.unit);
        if (!before.words.empty()) item.was += ", " + before.words;
        if (!now.words.empty()) item.is += ", " + now.words;
      }
    }
    if (item.turned) item.difference += (item.difference.empty() ? "" : "; ") + before.words + " → " + now.words;
    const State allowed = allowance(before, now, item);
    if (!item.turned) item.state = allowed;
  }

  State allowance(const Fact& before, const Fact& now, Item& item) const {
    const auto all_within = [&](const auto& most) {
      if (before.numbers.size() != now.numbers.size()) return false;
      for (std::size_t i = 0; i < now.numbers.size(); ++i) {
        if (!(std::abs(now.numbers[i] - before.numbers[i]) <= most(before.numbers[i]))) return false;
      }
      return true;
    };
    if (const Tolerance* one = find_tolerance(options_.tolerances, result_.name, now.id); one && one->share == 0) {
      item.tolerance =
          one->relative > 0 ? reports::percent(one->relative, 3) : reports::number(one->absolute, 4) + " " + now.unit;
      item.tolerance += " (tolerances.toml: " + one->reason + ")";
      return all_within([&](double old) { return one->relative > 0 ? one->relative * std::abs(old) : one->absolute; })
                 ? State::within_tolerance
                 : State::beyond;
    }
    const std::string id = case_of(now);
    if (id.empty() ? other_physics_.empty() : !other_physics_.contains(id)) {
      item.tolerance = "none (the same physics version gives the same bits)";
      return State::beyond;
    }
    if (const auto band = scatter(now)) {
      item.tolerance = fmt::format("{} {}: 95 % of the differences between {} seeds", reports::number(band->first, 3),
                                   now.unit, band->second);
      return all_within([&](double) { return band->first; }) ? State::within_scatter : State::beyond;
    }
    item.tolerance = "none (another physics version, and fewer than three seeds to tell the scatter from)";
    return State::beyond;
  }

  void compare_data() {
    for (const DataFile& now : is_.data) {
      Item& item = add(Kind::curve, now.file, now.file);
      const auto before = std::ranges::find(was_.data, now.file, &DataFile::file);
      if (before == was_.data.end()) {
        item.state = State::came;
      } else if (before->sha256 != now.sha256) {
        compare_curves(*before, now, item);
      }
    }
    for (const DataFile& before : was_.data) {
      if (std::ranges::find(is_.data, before.file, &DataFile::file) == is_.data.end()) {
        add(Kind::curve, before.file, before.file).state = State::gone;
      }
    }
  }

  void compare_curves(const DataFile& before, const DataFile& now, Item& item) {
    const Detail detail = was_.reduced || is_.reduced ? Detail::reference : Detail::fine;
    const std::vector<Curve> old_curves = curves_of(before, detail), new_curves = curves_of(now, detail);
    const auto same_place = [](const Curve& a) {
      return [&a](const Curve& b) { return a.key == b.key && a.y == b.y && a.x == b.x; };
    };
    double worst = 0, within = 0;
    for (const Curve& curve : new_curves) {
      const auto old = std::ranges::find_if(old_curves, same_place(curve));
      const std::string name = curve.key.empty() ? curve.y : curve.key + ": " + curve.y;
      if (old == old_curves.end()) {
        item.lines.push_back("+ " + name);
        continue;
      }
      within = std::max({within, curve.within, old->within});
      const double apart = distance(*old, curve);
      if (apart == 0) continue;
      worst = std::max(worst, apart);
      item.overlays.push_back({*old, curve, apart});
    }
    for (const Curve& old : old_curves) {
      if (std::ranges::none_of(new_curves, same_place(old))) {
        item.lines.push_back("- " + (old.key.empty() ? old.y : old.key + ": " + old.y));
      }
    }
    std::ranges::stable_sort(item.overlays, std::greater{}, &Overlay::distance);
    if (item.overlays.size() > 3) item.overlays.resize(3);
    item.state = State::beyond;
    item.tolerance = "none (the same physics version gives the same bits)";
    if (!other_physics_.empty()) item.tolerance = "none (not set for curves of another physics version)";
    if (worst > 0) {
      item.difference = reports::percent(worst, worst < 0.001 ? 4 : 2) + " of the range at most";
    } else if (item.lines.empty()) {
      item.difference =
          within > 0 ? "less than " + reports::percent(within, 2) + " of the range, which is what the reference keeps"
                     : "other heads or words of the table, or digits that are not drawn";
    } else {
      item.difference = old_curves.empty() ? "the reference keeps only its hash" : "other rows or columns";
    }
    if (const Tolerance* one = find_tolerance(options_.tolerances, result_.name, now.file); one && one->share > 0) {
      item.tolerance = reports::percent(one->share, 3) + " of the range (tolerances.toml: " + one->reason + ")";
      if (item.lines.empty() && std::max(worst, within) <= one->share) item.state = State::within_tolerance;
    }
  }

  void compare_pictures_of_study() {
    struct Pair {
      const Picture* was;
      const Picture* is;
      std::size_t item;
    };
    std::vector<Pair> pairs;
    std::vector<std::pair<const Picture*, std::size_t>> came, gone;
    for (const Picture& now : is_.pictures) {
      add(Kind::picture, now.id, now.title);
      const std::size_t at = result_.items.size() - 1;
      if (const Picture* before = find(was_.pictures, now.id)) {
        pairs.push_back({before, &now, at});
      } else {
        came.emplace_back(&now, at);
        result_.items[at].state = State::came;
      }
    }
    for (const Picture& before : was_.pictures) {
      if (find(is_.pictures, before.id)) continue;
      add(Kind::picture, before.id, before.title).state = State::gone;
      gone.emplace_back(&before, result_.items.size() - 1);
    }
    std::atomic<std::size_t> next = 0;
    std::vector<std::string> problems(pairs.size());
    const auto work = [&] {
      for (std::size_t i = next++; i < pairs.size(); i = next++) {
        try {
          compare_picture(*pairs[i].was, *pairs[i].is, result_.items[pairs[i].item]);
        } catch (const std::exception& error) {
          problems[i] = error.what();
        }
      }
    };
    {
      std::vector<std::jthread> others;
      for (int i = 1; i < options_.threads; ++i) others.emplace_back(work);
      work();
    }
    for (const std::string& problem : problems) {
      if (!problem.empty()) throw Unreadable(problem);
    }
    for (const auto& [now, at] : came) {
      Item& item = result_.items[at];
      if (!now->png.empty()) item.pictures = {{"new", "image/png", dem::read_file(now->png)}};
      for (const auto& [before, there] : gone) {
        if (!same_picture(*before, *now)) continue;
        item.difference = "the same picture was named " + before->id;
        result_.items[there].difference = "the same picture is now named " + now->id;
      }
    }
    for (const auto& [before, at] : gone) {
      if (!before->png.empty()) result_.items[at].pictures = {{"old", "image/png", dem::read_file(before->png)}};
    }
  }

  static bool same_picture(const Picture& was, const Picture& is) {
    if (!was.drawing.empty() && was.drawing == is.drawing) return true;
    if (is.png.empty() || (was.pixels.empty() && was.png.empty())) return false;
    if (was.pixels.empty() && dem::read_file(was.png) == dem::read_file(is.png)) return true;
    return pixels_of(was) == pixels_of(is);
  }

  void compare_picture(const Picture& was, const Picture& is, Item& item) const {
    if (same_picture(was, is)) return;
    item.state = State::beyond;
    if (is.png.empty() || was.png.empty()) {
      item.difference = was.pixels.empty() && was.png.empty() ? "the drawing" : "the picture";
      item.difference +=
          was.svg.empty() && was.png.empty() ? " changed; the reference keeps no copy of the old one" : " changed";
      item.tolerance = "none (drawing)";
      const auto show = [&](const std::string& label, const Picture& picture) {
        if (!picture.svg.empty()) item.pictures.push_back({label, "image/svg+xml", dem::read_file(picture.svg)});
        if (picture.svg.empty() && !picture.png.empty())
          item.pictures.push_back({label, "image/png", dem::read_file(picture.png)});
      };
      show("old", was);
      show("new", is);
      return;
    }
    render::Image now = render::read_png(is.png);
    std::string now_bytes = dem::read_file(is.png);
    if (was.factor > 1) {
      now = reduced_picture(now, was.factor);
      now_bytes = render::png_bytes(now, {}, render::Content::photograph);
    }
    const PictureDifference found = compare_pictures(render::read_png(was.png), now, was.factor);
    item.tolerance = "edges that are smoothed otherwise";
    double share = 0;
    if (const Tolerance* one = find_tolerance(options_.tolerances, result_.name, is.id); one && one->share > 0) {
      share = one->share;
      item.tolerance = reports::percent(share, 3) + " of the pixels (tolerances.toml: " + one->reason + ")";
    }
    if (!found.same_size) {
      item.difference = "another size";
    } else if (found.changed == 0) {
      item.difference = "less than what the reference keeps";
    } else {
      item.difference =
          fmt::format("{} of the pixels changed, {} beyond smoothed edges; similarity of the worst tile {:.2f}",
                      reports::percent(found.changed, 2), reports::percent(found.beyond, 3), found.worst);
    }
    if (found.same_size && (!found.seen || (share > 0 && found.beyond <= share))) item.state = State::within_tolerance;
    item.pictures = {{"old", "image/png", dem::read_file(was.png)}, {"new", "image/png", now_bytes}};
    if (found.same_size) {
      item.pictures.push_back(
          {"difference", "image/png", render::png_bytes(found.marked, {}, render::Content::drawing)});
    }
  }

  void compare_text() {
    if (was_.text.empty() || is_.text.empty()) return;  // one of them has no page
    const auto lines = [](const Snapshot& snapshot, const std::string& section) {
      const auto at = std::ranges::find(snapshot.text, section, &Passage::section);
      return at == snapshot.text.end() ? std::vector<std::string>{} : at->lines;
    };
    std::vector<std::string> sections;
    for (const Snapshot* snapshot : {&is_, &was_}) {
      for (const Passage& passage : snapshot->text) {
        if (std::ranges::find(sections, passage.section) == sections.end()) sections.push_back(passage.section);
      }
    }
    for (const std::string& section : sections) {
      const std::vector<std::string> old_lines = lines(was_, section), new_lines = lines(is_, section);
      Item& item = add(Kind::text, "text/" + section, "section " + section);
      if (old_lines == new_lines) continue;
      item.state = old_lines.empty() ? State::came : new_lines.empty() ? State::gone : State::beyond;
      std::multiset<std::string> left(new_lines.begin(), new_lines.end());
      std::multiset<std::string> old_left(old_lines.begin(), old_lines.end());
      for (const std::string& line : old_lines) {
        if (const auto at = left.find(line); at != left.end()) {
          left.erase(at);
        } else {
          item.lines.push_back("- " + line);
        }
      }
      for (const std::string& line : new_lines) {
        if (const auto at = old_left.find(line); at != old_left.end()) {
          old_left.erase(at);
        } else {
          item.lines.push_back("+ " + line);
        }
      }
      item.difference = item.lines.empty() ? "another order" : fmt::format("{} lines", item.lines.size());
      item.tolerance = "none";
    }
  }

  /// A difference whose cause no key names.
  void explain() {
    if (result_.alarms() == 0 || !result_.causes.empty()) return;
    std::size_t numbers = 0, bits = 0, words = 0;
    for (const Item& item : result_.items) {
      if (item.kind == Kind::study_case && item.alarms()) return;  // the cases themselves say it
      if (item.state == State::same || (item.kind != Kind::result && item.kind != Kind::check)) continue;
      if (item.turned) ++words;
      if (!item.moved) continue;
      ++numbers;
      if (item.difference.find("in the last place") != std::string::npos) ++bits;
    }
    if (numbers == 0) {
      result_.causes.push_back({words > 0
                                    ? "the same input and the same numbers: a check is judged otherwise"
                                    : "the same input and the same results: the drawing, the words of the report or "
                                      "the judgement of published numbers changed"});
    } else if (bits == numbers) {
      result_.causes.push_back(
          {"the same input and physics version, and results that differ in their last bits alone: another compiler, "
           "flag "
           "or library"});
    } else {
      result_.causes.push_back(
          {"the same input and physics version, and other results: another program without another physics version"});
    }
  }

  const Snapshot& was_;
  const Snapshot& is_;
  const Options& options_;
  StudyComparison result_;
  std::set<std::string> other_physics_;  // cases
  std::set<std::string> other_input_;    // cases of which a key changed
};

}  // namespace

std::string_view state_words(State state) {
  switch (state) {
    case State::same:
      return "same";
    case State::within_tolerance:
      return "within tolerance";
    case State::within_scatter:
      return "within the scatter of seeds";
    case State::beyond:
      return "beyond tolerance";
    case State::came:
      return "new";
    case State::gone:
      break;
  }
  return "gone";
}

std::string_view kind_words(Kind kind) {
  switch (kind) {
    case Kind::study_case:
      return "cases";
    case Kind::result:
      return "results";
    case Kind::check:
      return "checks";
    case Kind::published:
      return "published numbers";
    case Kind::curve:
      return "curves and tables";
    case Kind::picture:
      return "pictures";
    case Kind::text:
      break;
  }
  return "sections of text";
}

std::size_t StudyComparison::alarms() const {
  return static_cast<std::size_t>(std::ranges::count_if(items, &Item::alarms));
}

bool StudyComparison::well() const { return problem.empty() && !is_gone && alarms() == 0; }

std::size_t StudyComparison::count(Kind kind, State state) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(items, [&](const Item& item) { return item.kind == kind && item.state == state; }));
}

std::string StudyComparison::sentence() const {
  if (!problem.empty()) return "could not be compared: " + problem;
  if (is_new) return "new: there is no reference";
  if (is_gone) return "gone";
  std::vector<std::string> parts;
  for (const Kind kind :
       {Kind::study_case, Kind::result, Kind::check, Kind::published, Kind::curve, Kind::picture, Kind::text}) {
    std::size_t all = 0, alarm = 0;
    for (const Item& item : items) {
      if (item.kind != kind) continue;
      ++all;
      if (item.alarms()) ++alarm;
    }
    if (alarm > 0) parts.push_back(fmt::format("{} of {} {}", alarm, all, kind_words(kind)));
  }
  if (!parts.empty()) return "changed: " + reports::listed(parts);
  const auto allowed = static_cast<std::size_t>(
      std::ranges::count_if(items, [](const Item& item) { return item.state != State::same; }));
  return allowed == 0 ? "nothing changed" : fmt::format("nothing changed beyond tolerance ({} within)", allowed);
}

double distance(const Curve& was, const Curve& is) {
  if (was.points == is.points) return 0;
  double low[2], high[2];
  bool first = true;
  for (const auto* points : {&was.points, &is.points}) {
    for (const auto& [x, y] : *points) {
      const double values[2] = {x, y};
      for (int k = 0; k < 2; ++k) {
        low[k] = first ? values[k] : std::min(low[k], values[k]);
        high[k] = first ? values[k] : std::max(high[k], values[k]);
      }
      first = false;
    }
  }
  if (first) return 0;
  double scale[2];
  for (int k = 0; k < 2; ++k) scale[k] = high[k] > low[k] ? high[k] - low[k] : 1;
  const auto scaled = [&](const std::vector<Point>& points) {
    std::vector<Point> all;
    for (const auto& [x, y] : points) all.emplace_back((x - low[0]) / scale[0], (y - low[1]) / scale[1]);
    return all;
  };
  const std::vector<Point> a = scaled(was.points), b = scaled(is.points);
  if (a.size() == 1 && b.size() == 1) {  // a cell of a table: the change of the value
    const double old = was.points[0].second, now = is.points[0].second;
    return std::abs(now - old) / std::max({std::abs(old), std::abs(now), 1e-300});
  }
  double most = 0;
  for (const Point& p : a) most = std::max(most, to_line(p, b));
  for (const Point& p : b) most = std::max(most, to_line(p, a));
  return most;
}

StudyComparison compare(const Snapshot& was, const Snapshot& is, const Options& options) {
  try {
    return Comparer(was, is, options).compare();
  } catch (const Unreadable& error) {
    return {.name = is.name(), .problem = error.what()};
  } catch (const dem::EnvironmentError& error) {
    return {.name = is.name(), .problem = error.what()};
  }
}

}  // namespace comparison

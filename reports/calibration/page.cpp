#include "reports/calibration/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/files.h"
#include "engine/scenario/units.h"
#include "reports/page/again.h"
#include "reports/page/downloads.h"
#include "reports/page/typeset.h"
#include "reports/template.h"
#include "reports/text.h"

namespace calibrate {
namespace {

using Data = reports::PageData;
using Json = nlohmann::ordered_json;
using reports::capital;
using reports::number;

Data list() { return Data{Data::type::list}; }

Data cells(const std::vector<std::string>& texts) {
  Data all = list();
  for (const std::string& text : texts) all.push_back(Data{"cell", text});
  return all;
}

void flag(Data& data, const std::string& name, bool value) { data.set(name, value); }

std::string in_unit(double si, const std::string& unit) {
  return number(unit.empty() ? si : si / dem::to_si(1, unit), 4) + (unit.empty() ? "" : " " + unit);
}

/// The values of a parameter that is of one key or of two that move together; else the factor.
std::string value_words(const Parameter& parameter, const ParameterResult& result) {
  const bool one = std::ranges::all_of(parameter.start, [&](double v) { return v == parameter.start.front(); });
  return one ? in_unit(result.values.front(), parameter.unit) : number(result.factor, 3) + " × the start";
}

std::string interval_words(const Parameter& parameter, const ParameterResult& result) {
  if (!result.is_determined) return "not determined";
  const bool one = std::ranges::all_of(parameter.start, [&](double v) { return v == parameter.start.front(); });
  const double low = one ? parameter.start.front() * result.low : result.low,
               high = one ? parameter.start.front() * result.high : result.high;
  return one ? in_unit(low, parameter.unit) + " to " + in_unit(high, parameter.unit)
             : number(low, 3) + " to " + number(high, 3);
}

std::string start_words(const Parameter& parameter) {
  const bool one = std::ranges::all_of(parameter.start, [&](double v) { return v == parameter.start.front(); });
  if (one) return in_unit(parameter.start.front(), parameter.unit);
  std::vector<std::string> all;
  for (const double start : parameter.start) {
    const std::string text = in_unit(start, parameter.unit);
    if (std::ranges::find(all, text) == all.end()) all.push_back(text);
  }
  return reports::joined(all, ", ");
}

/// "± 3 %", of a standard deviation in logarithms at 95 %.
std::string percent_words(double deviation) { return fmt::format("± {:.0f} %", 100 * std::expm1(1.96 * deviation)); }

/// The direction that no measured value sees: "friction up".
std::string direction_words(const Subject& subject, const dem::calibration::Kept& kept) {
  std::vector<std::pair<double, std::string>> parts;
  for (std::size_t k = 0; k < kept.direction.size(); ++k) {
    if (std::abs(kept.direction[k]) < 0.15) continue;
    parts.emplace_back(std::abs(kept.direction[k]),
                       fmt::format("{} {}", subject.candidates[k].name, kept.direction[k] > 0 ? "up" : "down"));
  }
  std::ranges::stable_sort(parts, std::greater{}, [](const auto& part) { return part.first; });
  std::vector<std::string> words;
  for (const auto& part : parts) words.push_back(part.second);
  return reports::listed(words);
}

std::string kept_words(const Subject& subject, const dem::calibration::Kept& kept, const Advice* advice) {
  std::string text;
  if (!std::isfinite(kept.deviation)) {
    text = fmt::format("No measured value moves along this direction: {}.", direction_words(subject, kept));
  } else {
    text = fmt::format("The measured values fix this direction to {} only (95 %): {}.", percent_words(kept.deviation),
                       direction_words(subject, kept));
  }
  if (advice) {
    text +=
        advice->measure.empty()
            ? " None of the usual tests would determine it beside the others: keep it at a value from the literature."
            : fmt::format(" To determine it, measure {}: it would then be known to {}.", advice->measure,
                          percent_words(advice->deviation));
  }
  return text;
}

const Advice* advice_of(const SubjectResult& result, std::size_t candidate) {
  const auto at = std::ranges::find(result.advice, candidate, &Advice::candidate);
  return at == result.advice.end() ? nullptr : &*at;
}

Data targets_data(const SubjectResult& result) {
  Data rows = list();
  for (std::size_t i = 0; i < result.subject.targets.size(); ++i) {
    const Target& target = result.subject.targets[i];
    Data row;
    row.set("name", target.name());
    row.set("measured", reports::laboratory_text(target.number));
    const TargetResult* ours = i < result.targets.size() ? &result.targets[i] : nullptr;
    const bool there = ours && std::isfinite(ours->ours.value);
    row.set("ours", there ? number(ours->ours.value, 4) : "–");
    row.set("interval",
            there && ours->ours.has_interval() ? number(ours->ours.low, 4) + " to " + number(ours->ours.high, 4) : "");
    row.set("specimens", there ? std::to_string(ours->specimens) : "");
    row.set("scatter", there ? number(ours->deviation, 2) : "");
    row.set("deviation", !there ? ""
                         : target.is_logarithmic()
                             ? reports::with_sign(reports::percent(ours->ours.value / target.number.value - 1))
                             : reports::with_sign(reports::fixed(ours->ours.value - target.number.value, 3)));
    const reports::Verdict verdict = ours ? ours->verdict : reports::Verdict::not_computed;
    row.set("verdict", std::string(reports::laboratory_word(verdict)));
    row.set("verdict_class", verdict == reports::Verdict::met         ? "met"
                             : verdict == reports::Verdict::missed    ? "missed"
                             : verdict == reports::Verdict::undecided ? "undecided"
                                                                      : "open");
    rows.push_back(row);
  }
  return rows;
}

Data parameters_data(const SubjectResult& result) {
  Data rows = list();
  for (const ParameterResult& one : result.parameters) {
    const Parameter& parameter = result.subject.candidates[one.candidate];
    Data row;
    row.set("name", parameter.name);
    row.set("start", start_words(parameter));
    row.set("value", value_words(parameter, one));
    row.set("interval", interval_words(parameter, one));
    row.set("note", !one.is_determined          ? "the tests that were run hardly react to it"
                    : one.at_low || one.at_high ? "at the end of its range"
                                                : "");
    rows.push_back(row);
  }
  return rows;
}

Data correlation_data(const SubjectResult& result) {
  Data rows = list();
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    std::vector<std::string> texts;
    for (std::size_t j = 0; j < result.parameters.size(); ++j) {
      const double value = result.correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
      texts.push_back(j > k ? "" : j == k ? "1" : reports::fixed(value, 2));
    }
    Data row;
    row.set("name", result.subject.candidates[result.parameters[k].candidate].name);
    row.set("cells", cells(texts));
    rows.push_back(row);
  }
  return rows;
}

Data path_data(const SubjectResult& result) {
  Data rows = list();
  int trial = 0;
  for (const Step& step : result.path) {
    std::vector<std::string> texts;
    for (const double factor : step.factors) texts.push_back(reports::fixed(factor, 3));
    for (std::size_t i = 0; i < step.values.size(); ++i)
      texts.push_back(std::isfinite(step.values[i]) ? number(step.values[i], 4) : "–");
    Data row;
    row.set("trial", std::to_string(++trial));
    row.set("stage", step.stage == "mean" ? fmt::format("mean of {}", step.specimens())
                     : step.seeds > 1     ? fmt::format("{} fresh seeds", step.seeds)
                                          : step.stage);
    row.set("cells", cells(texts));
    row.set("note", step.failed            ? "failed"
                    : step.is_difference   ? "derivative"
                    : step.stage == "mean" ? "calibrated"
                    : step.is_best         ? "best yet"
                                           : "");
    rows.push_back(row);
  }
  return rows;
}

/// May break after dots and underscores, in a narrow column.
std::string breaking(const std::string& name) {
  std::string text;
  for (const char c : name) {
    text += c;
    if (c == '.' || c == '_') text += "\u200b";
  }
  return text;
}

std::vector<std::string> path_heads(const SubjectResult& result) {
  std::vector<std::string> heads;
  for (const std::size_t k : result.subject.moved) {
    heads.push_back(breaking(result.subject.candidates[k].name));
  }
  for (const Target& target : result.subject.targets) {
    heads.push_back(target.symbol() + (target.number.unit.empty() ? "" : " (" + std::string(target.number.unit) + ")"));
  }
  return heads;
}

std::string condition_words(double condition) { return std::isfinite(condition) ? number(condition, 2) : "infinite"; }

}  // namespace

render::Chart path_chart(const SubjectResult& result) {
  render::Chart chart;
  chart.x.title = "Trial";
  chart.left.title = "Ours less measured (%)";
  double largest = 1;
  for (std::size_t i = 0; i < result.subject.targets.size(); ++i) {
    const Target& target = result.subject.targets[i];
    render::Series series;
    series.label = target.symbol() + (target.is_logarithmic() ? "" : " (× 100)");
    series.colour = render::palette(i);
    series.line = render::line_style(i);
    series.marker = render::marker_style(i);
    for (std::size_t t = 0; t < result.path.size(); ++t) {
      const Step& step = result.path[t];
      if (step.is_difference || !std::isfinite(step.values[i])) continue;
      series.x.push_back(static_cast<double>(t + 1));
      series.y.push_back(target.is_logarithmic() ? 100 * (step.values[i] / target.number.value - 1)
                                                 : 100 * (step.values[i] - target.number.value));
      largest = std::max(largest, std::abs(series.y.back()));
    }
    if (!series.x.empty()) chart.series.push_back(series);
  }
  chart.marks.push_back(
      {.kind = render::Mark::Kind::horizontal, .x = 0, .y = 0, .label = "", .colour = {0.4, 0.4, 0.4}});
  chart.x.low = 0;
  chart.x.high = static_cast<double>(result.path.size() + 1);
  chart.left.low = -1.1 * largest;
  chart.left.high = 1.1 * largest;
  chart.legend = render::Chart::Legend::below;
  chart.width = render::page_width;
  chart.height = 300;
  return chart;
}

std::string page(const dem::Scenario& scenario, const Outcome& outcome, const PageFacts& facts,
                 const std::vector<std::filesystem::path>& charts) {
  Data data;
  data.set("style", dem::read_file(facts.assets / "page" / "report.css"));
  data.set("title", facts.title);
  data.set("scenario", facts.scenario);
  data.set("scale", facts.scale);
  data.set("seed", std::to_string(facts.seed));
  data.set("engine_version", facts.engine_version);
  data.set("rock", facts.rock);
  data.set("rock_text", facts.rock_text);
  data.set("rock_href", reports::data_uri(facts.rock_text, "x.toml"));
  data.set("again", reports::again_data(scenario, facts.again));
  data.set("sources", reports::sources_data(scenario, facts.again, false));
  Data findings = list();
  const auto find = [&](const std::string& text, const char* state) {
    Data item;
    item.set("text", text);
    item.set("state", std::string(state));
    findings.push_back(item);
  };
  Data subjects = list();
  for (std::size_t s = 0; s < outcome.subjects.size(); ++s) {
    const SubjectResult& result = outcome.subjects[s];
    const Subject& subject = result.subject;
    int met = 0, missed = 0, undecided = 0;
    for (const TargetResult& one : result.targets) {
      met += one.verdict == reports::Verdict::met;
      missed += one.verdict == reports::Verdict::missed;
      undecided += one.verdict == reports::Verdict::undecided;
    }
    find(fmt::format("{}: of {} measured value{} {} within the uncertainty, {} outside, {} undecided, by means over {} "
                     "specimens; {} of {} tests.",
                     capital(subject.title()), subject.targets.size(), subject.targets.size() == 1 ? "" : "s", met,
                     missed, undecided, result.specimens, result.tests, subject.budget),
         missed > 0 || result.targets.empty() ? "bad"
         : undecided > 0                      ? "plain"
                                              : "good");
    for (const std::string& problem : result.problems) find(problem, "bad");
    for (const std::string& note : subject.notes) find(note, "plain");

    Data block;
    block.set("title", capital(subject.title()));
    block.set("id", "subject-" + std::to_string(s + 1));
    block.set("targets", targets_data(result));
    block.set("parameters", parameters_data(result));
    std::vector<std::string> names;
    for (const ParameterResult& one : result.parameters) names.push_back(subject.candidates[one.candidate].name);
    block.set("names", cells(names));
    flag(block, "has_correlation", result.parameters.size() > 1);
    block.set("correlation", correlation_data(result));
    block.set("condition", condition_words(result.condition));
    block.set("condition_of_all", condition_words(subject.known.condition_of_all));
    Data kept = list();
    for (const dem::calibration::Kept& one : subject.known.kept) {
      Data row;
      row.set("name", subject.candidates[one.unknown].name);
      row.set("value", start_words(subject.candidates[one.unknown]));
      row.set("why", kept_words(subject, one, advice_of(result, one.unknown)));
      kept.push_back(row);
    }
    flag(block, "has_kept", !subject.known.kept.empty());
    block.set("kept", kept);
    block.set("heads", cells(path_heads(result)));
    block.set("path", path_data(result));
    Data ends = list();
    for (const std::string& end : result.stage_ends) ends.push_back(Data{"end", end});
    block.set("ends", ends);
    block.set("tests", std::to_string(result.tests));
    block.set("steps", reports::count(std::round(result.steps)));
    block.set("chart", s < charts.size() ? reports::data_uri(charts[s]) : "");
    flag(block, "has_chart", s < charts.size());
    subjects.push_back(block);
  }
  data.set("findings", findings);
  data.set("subjects", subjects);
  return reports::typeset(reports::fill_template(facts.assets / "page" / "calibration.html", std::move(data)));
}

std::string json(const Outcome& outcome, const PageFacts& facts) {
  const auto or_null = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json all{{"format", 1},
           {"scenario", facts.scenario},
           {"scale", facts.scale},
           {"seed", facts.seed},
           {"met", outcome.is_met()},
           {"values", Json::object()},
           {"subjects", Json::array()}};
  for (const auto& [key, value] : outcome.values) all["values"][key] = value;
  for (const SubjectResult& result : outcome.subjects) {
    const Subject& subject = result.subject;
    Json one{{"mineral", subject.mineral},
             {"met", result.is_met},
             {"targets", Json::array()},
             {"parameters", Json::array()},
             {"kept", Json::array()},
             {"correlation", Json::array()},
             {"condition", or_null(result.condition)},
             {"path", Json::array()},
             {"stages", result.stage_ends},
             {"problems", result.problems},
             {"notes", subject.notes},
             {"tests", result.tests},
             {"steps", std::round(result.steps)}};
    for (std::size_t i = 0; i < subject.targets.size(); ++i) {
      const reports::LaboratoryNumber& number = subject.targets[i].number;
      Json target{{"key", number.key},
                  {"confining_pressure", number.pressure},
                  {"unit", number.unit},
                  {"measured", {number.low, number.high}},
                  {"computed", Json()}};
      if (i < result.targets.size()) {
        const TargetResult& ours = result.targets[i];
        target["computed"] = or_null(ours.ours.value);
        if (ours.ours.has_interval()) target["interval"] = {ours.ours.low, ours.ours.high};
        target["specimens"] = ours.specimens;
        target["deviation"] = or_null(ours.deviation);
        target["verdict"] = reports::laboratory_word(ours.verdict);
      }
      one["targets"].push_back(std::move(target));
    }
    for (std::size_t k = 0; k < result.parameters.size(); ++k) {
      const ParameterResult& parameter = result.parameters[k];
      one["parameters"].push_back({{"name", subject.candidates[parameter.candidate].name},
                                   {"factor", parameter.factor},
                                   {"interval", parameter.is_determined ? Json{parameter.low, parameter.high} : Json()},
                                   {"keys", subject.candidates[parameter.candidate].keys},
                                   {"values", parameter.values},
                                   {"at_end_of_range", parameter.at_low || parameter.at_high}});
      Json row = Json::array();
      for (std::size_t j = 0; j < result.parameters.size(); ++j)
        row.push_back(result.correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
      one["correlation"].push_back(std::move(row));
    }
    for (const dem::calibration::Kept& kept : subject.known.kept) {
      const Advice* advice = advice_of(result, kept.unknown);
      one["kept"].push_back({{"name", subject.candidates[kept.unknown].name},
                             {"deviation", or_null(kept.deviation)},
                             {"direction", kept.direction},
                             {"measure", advice ? advice->measure : ""}});
    }
    for (const Step& step : result.path) {
      Json values = Json::array();
      for (const double value : step.values) values.push_back(or_null(value));
      one["path"].push_back({{"stage", step.stage},
                             {"seeds", step.seeds},
                             {"factors", step.factors},
                             {"values", values},
                             {"best", step.is_best},
                             {"failed", step.failed}});
    }
    all["subjects"].push_back(std::move(one));
  }
  return all.dump(1) + "\n";
}

std::vector<std::string> last_words(const Outcome& outcome) {
  std::vector<std::string> lines;
  for (const SubjectResult& result : outcome.subjects) {
    for (std::size_t i = 0; i < result.targets.size(); ++i) {
      const Target& target = result.subject.targets[i];
      const TargetResult& ours = result.targets[i];
      const std::string interval = ours.ours.has_interval()
                                       ? fmt::format(" ({} to {})", number(ours.ours.low, 4), number(ours.ours.high, 4))
                                       : "";
      lines.push_back(fmt::format("{}: {} {}{}, measured {}: {}", result.subject.title(), target.symbol(),
                                  number(ours.ours.value, 4), interval, reports::laboratory_text(target.number),
                                  reports::laboratory_word(ours.verdict)));
    }
  }
  return lines;
}

}  // namespace calibrate

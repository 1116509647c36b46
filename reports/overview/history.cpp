#include "reports/overview/history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/append.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace overview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest = 400;  // nights that are looked at: the last ones

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

Json night_json(const StudyRow& row, const std::string& label, const std::string& date) {
  Json numbers = Json::object();
  for (const Number& number : row.numbers) numbers["results/" + number.id] = number.value;
  for (const CheckOf& check : row.checks) {
    if (check.value) numbers["checks/" + check.id] = *check.value;
  }
  numbers["seconds"] = row.seconds;
  for (const CaseOf& one : row.cases) {
    if (one.seconds) numbers["seconds/" + one.id] = *one.seconds;
  }
  return {{"study", row.folder}, {"label", label}, {"date", date}, {"state", row.state()}, {"numbers", numbers}};
}

}  // namespace

void append_history(const std::filesystem::path& file, const std::vector<StudyRow>& rows, const std::string& label,
                    const std::string& date) {
  dem::FileLock lock(file);
  for (const StudyRow& row : rows) lock.append(night_json(row, label, date).dump());
}

History read_history(const std::filesystem::path& file) {
  constexpr std::uint64_t largest = std::uint64_t{1} << 30;
  const std::string text = dem::read_input(file, largest, {}, "--history");
  History history;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) break;
    try {
      const Json json = Json::parse(text.substr(at, end - at));
      Night night{json.at("study").get<std::string>(), json.value("label", ""), json.value("date", "")};
      for (const auto& [id, value] : json.at("numbers").items()) night.numbers.emplace_back(id, value.get<double>());
      history.nights.push_back(std::move(night));
    } catch (const Json::exception&) {
      ++history.damaged;
    }
    at = end + 1;
  }
  return history;
}

std::vector<Series> series_of(const History& history, const std::string& study) {
  std::vector<Series> all;
  std::map<std::string, std::size_t> places;
  for (const Night& night : history.nights) {
    if (night.study != study) continue;
    for (const auto& [id, value] : night.numbers) {
      const auto [at, is_new] = places.try_emplace(id, all.size());
      if (is_new) all.push_back({id});
      all[at->second].values.push_back(value);
      all[at->second].labels.push_back(night.label.empty() ? night.date : night.label);
    }
  }
  for (Series& series : all) {
    if (series.values.size() <= longest) continue;
    const auto many = static_cast<std::ptrdiff_t>(series.values.size() - longest);
    series.values.erase(series.values.begin(), series.values.begin() + many);
    series.labels.erase(series.labels.begin(), series.labels.begin() + many);
  }
  return all;
}

std::vector<Step> steps(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 2 || std::ranges::all_of(values, [&](double value) { return value == values[0]; })) return {};
  std::vector<double> changes;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) changes.push_back(std::abs(values[i] - values[i - 1]));
  }
  const double noise = median(changes) / std::sqrt(2.0);
  const std::size_t least = noise > 0 ? 2 : 1;
  const double penalty = noise > 0 ? 4 * std::log(static_cast<double>(n)) * noise : 0;
  if (n < 2 * least) return {};
  // best[j]: the least cost of the first j values; from[j]: where its last piece begins.
  const double none = std::numeric_limits<double>::infinity();
  std::vector<double> best(n + 1, none);
  std::vector<std::size_t> from(n + 1, 0);
  best[0] = -penalty;
  std::vector<std::vector<double>> cost(n, std::vector<double>(n + 1, none));
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> sorted;
    for (std::size_t j = i; j < n; ++j) {
      sorted.insert(std::ranges::upper_bound(sorted, values[j]), values[j]);
      const std::size_t half = sorted.size() / 2;
      double sum = 0;
      for (std::size_t k = 0; k < half; ++k) sum += sorted[sorted.size() - 1 - k] - sorted[k];
      cost[i][j + 1] = sum;
    }
  }
  for (std::size_t j = least; j <= n; ++j) {
    for (std::size_t i = 0; i + least <= j; ++i) {
      const double total = best[i] + penalty + cost[i][j];
      if (total < best[j]) {
        best[j] = total;
        from[j] = i;
      }
    }
  }
  std::vector<std::size_t> begins;
  for (std::size_t j = n; j > 0; j = from[j]) begins.insert(begins.begin(), from[j]);
  std::vector<Step> found;
  const auto level = [&](std::size_t piece) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(begins[piece]);
    const auto end =
        piece + 1 < begins.size() ? values.begin() + static_cast<std::ptrdiff_t>(begins[piece + 1]) : values.end();
    return median({begin, end});
  };
  for (std::size_t piece = 1; piece < begins.size(); ++piece) {
    found.push_back({begins[piece], level(piece - 1), level(piece)});
  }
  return found;
}

}  // namespace overview

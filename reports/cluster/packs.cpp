#include "reports/cluster/packs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <tuple>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace cluster {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_file = std::uint64_t{64} << 20;

/// Makers of what several packs need and nobody has: one a specimen, by the first line that needs it.
std::vector<Pack> makers(const Manifest& manifest, const std::vector<Pack>& work,
                         const std::function<bool(const std::string&)>& missing) {
  std::map<std::string, std::set<std::size_t>> users;  // of a specimen, packs
  std::map<std::string, std::size_t> first;            // the line that makes it
  for (std::size_t p = 0; p < work.size(); ++p) {
    for (const std::size_t line : work[p].lines) {
      for (const std::string& specimen : manifest[line - 1].specimens) {
        users[specimen].insert(p);
        first.try_emplace(specimen, line);
      }
    }
  }
  std::set<std::size_t> lines;
  for (const auto& [specimen, in] : users) {
    if (in.size() > 1 && missing(specimen)) lines.insert(first.at(specimen));
  }
  std::vector<Pack> all;
  for (const std::size_t line : lines) {
    const Line& one = manifest[line - 1];
    all.push_back(
        {.lines = {line}, .specimens_only = true, .threads = 1, .seconds = one.seconds, .memory = one.memory});
  }
  return all;
}

}  // namespace

std::vector<Pack> packs(const Manifest& manifest, const std::vector<std::size_t>& lines, const PackOptions& options,
                        const std::function<bool(const std::string&)>& missing) {
  const auto threads_of = [&](std::size_t line) {
    return options.threads > 0 ? options.threads : std::max(manifest[line - 1].threads, 1);
  };
  using Place = std::tuple<int, const std::vector<std::string>&>;
  const auto place = [&](std::size_t line) { return Place(threads_of(line), manifest[line - 1].specimens); };
  std::vector<std::size_t> order = lines;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  std::vector<Pack> work;
  for (const std::size_t line : order) {
    const Line& one = manifest[line - 1];
    const bool fits = !work.empty() && work.back().threads == threads_of(line) &&
                      (options.cases_per_job > 0 ? work.back().lines.size() < options.cases_per_job
                                                 : work.back().seconds + one.seconds <= options.seconds);
    if (!fits) work.push_back({.lines = {}, .threads = threads_of(line)});
    Pack& pack = work.back();
    pack.lines.push_back(line);
    pack.seconds += one.seconds;
    pack.memory = std::max(pack.memory, one.memory);
  }
  std::vector<Pack> all = makers(manifest, work, missing);
  all.insert(all.end(), work.begin(), work.end());
  return all;
}

std::vector<Array> arrays(const std::vector<Pack>& packs, std::size_t most) {
  std::vector<Array> all;
  for (std::size_t at = 0; at < packs.size();) {
    Array array{at, 0};
    while (at < packs.size() && array.count < std::max<std::size_t>(most, 1) &&
           packs[at].specimens_only == packs[array.first].specimens_only &&
           packs[at].threads == packs[array.first].threads) {
      ++at;
      ++array.count;
    }
    all.push_back(array);
  }
  return all;
}

fs::path packs_file(const fs::path& manifest) { return manifest.parent_path() / "packs.jsonl"; }

std::string to_text(const std::vector<Pack>& packs) {
  std::string text;
  for (const Pack& pack : packs) {
    text += Json{{"lines", pack.lines},
                 {"specimens_only", pack.specimens_only},
                 {"threads", pack.threads},
                 {"seconds", pack.seconds},
                 {"memory_mib", pack.memory >> 20}}
                .dump() +
            "\n";
  }
  return text;
}

std::vector<Pack> read_packs(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw dem::InputError(dem::Location{file.string(), 0, 0}, {}, "there are no packs beside the manifest",
                          "name lines in the place of --pack");
  }
  const std::string text = dem::read_input(file, largest_file);
  std::vector<Pack> packs;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    try {
      const Json json = Json::parse(text.substr(from, end - from));
      Pack pack;
      json.at("lines").get_to(pack.lines);
      json.at("specimens_only").get_to(pack.specimens_only);
      json.at("threads").get_to(pack.threads);
      json.at("seconds").get_to(pack.seconds);
      pack.memory = json.at("memory_mib").get<std::uint64_t>() << 20;
      packs.push_back(std::move(pack));
    } catch (const nlohmann::json::exception&) {
      throw dem::InputError(dem::Location{file.string(), static_cast<int>(packs.size()) + 1, 0}, {},
                            "this is no line of packs", "submit again");
    }
    from = end + 1;
  }
  return packs;
}

Pack read_pack(const fs::path& file, std::size_t number) {
  const std::vector<Pack> packs = read_packs(file);
  if (number < packs.size()) return packs[number];
  throw dem::InputError(dem::Location{file.string(), 0, 0}, "--pack", fmt::format("there is no pack {}", number),
                        fmt::format("there are {}, counted from 0", packs.size()));
}

}  // namespace cluster

#pragma once
// How the lines of a manifest become jobs: small cases go together, specimens that packs share come first, and a job array has no
// more elements than the cluster allows.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/cluster/manifest.h"

namespace cluster {

/// What one job does, line after line.
struct Pack {
  std::vector<std::size_t> lines;  ///< of the manifest, from 1
  bool specimens_only = false;     ///< makes what others wait for, and simulates nothing
  int threads = 1;
  double seconds = 0;
  std::uint64_t memory = 0;

  bool operator==(const Pack&) const = default;
};

struct PackOptions {
  double seconds = 1200;          ///< a pack is filled up to this, so that packs of small cases take 10 to 20 minutes
  std::size_t cases_per_job = 0;  ///< that many in the place of it; 0: by time
  int threads = 0;                ///< of every job; 0: as many as serve its cases
};

/// Packs of these lines. Those that make specimens stand first: of the specimens that several packs need and for which
/// `missing` says so. Then by threads. Lines that share a specimen stay together.
std::vector<Pack> packs(const Manifest& manifest, const std::vector<std::size_t>& lines, const PackOptions& options,
                        const std::function<bool(const std::string& specimen)>& missing);

/// A job array over neighbouring packs; element k is pack first + k.
struct Array {
  std::size_t first = 0;
  std::size_t count = 0;

  bool operator==(const Array&) const = default;
};

/// Arrays of at most `most` elements, each over packs of the same kind and threads.
std::vector<Array> arrays(const std::vector<Pack>& packs, std::size_t most);

/// packs.jsonl, a line a pack, beside the manifest.
std::filesystem::path packs_file(const std::filesystem::path& manifest);
std::string to_text(const std::vector<Pack>& packs);
/// Throw dem::InputError naming the file: it is missing or broken, or has no such pack (from 0).
std::vector<Pack> read_packs(const std::filesystem::path& file);
Pack read_pack(const std::filesystem::path& file, std::size_t number);

}  // namespace cluster

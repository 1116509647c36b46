#pragma once
// References: what a later comparison needs of a study that was accepted, and only that, small enough for a repository.
//   DIR/NAME.SCALE/reference.json       numbers, curves, words, contents of the cases; hashes of the pictures
//   DIR/NAME.SCALE/pictures/HASH.png    reduced pictures; HASH.svg: small drawings
//   DIR/accepted.jsonl                  a line for each acceptance: what, old, new, reason, date
//   DIR/tolerances.toml                 see tolerances.h
// A reference is replaced by renaming reference.json: it is the old one or the new one, whenever the program is killed.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/comparison/compare.h"
#include "reports/comparison/snapshot.h"

namespace comparison {

inline constexpr int reference_format = 1;

bool is_reference(const std::filesystem::path& folder);

/// Throws Unreadable for a reference of another format, or one that was cut short.
Snapshot read_reference(const std::filesystem::path& folder);

/// A report or a reference, whichever the folder holds. Throws Unreadable.
Snapshot read_either(const std::filesystem::path& folder);

struct Acceptance {
  std::vector<std::string> items{};  ///< patterns of ids; empty: the whole study
  std::string reason;
  std::string date;  ///< for the log
};

struct Accepted {
  std::vector<Item> changed{};  ///< what is different now, as compared before
  bool is_new = false;
  std::uintmax_t bytes = 0;         ///< of the reference
  std::size_t without_picture = 0;  ///< pictures of which nothing but the hash fits
};

/// Makes the report in `folder` the reference of its study below `references`, whole or not at all, with a line in the log
/// when it was made. Throws dem::InputError when a pattern fits nothing, or items are asked for and there is no reference
/// yet; Unreadable; dem::EnvironmentError.
Accepted accept(const std::filesystem::path& folder, const std::filesystem::path& references,
                const Acceptance& acceptance, const Options& options);

/// The most bytes of a reference of this scale.
std::uintmax_t most_bytes(const std::string& scale);

}  // namespace comparison

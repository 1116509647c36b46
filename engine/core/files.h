#pragma once
// Files that are either whole or not there: written under a temporary name in the same folder, then renamed.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/core/errors.h"

namespace dem {

/// The path of `name`, which may have folders, in `folder`. Throws EnvironmentError when it lies elsewhere: absolute, with
/// "..", or with a NUL, which the system takes for its end.
std::filesystem::path inside(const std::filesystem::path& folder, const std::filesystem::path& name);

/// Calls `write` with a temporary path beside `path` (its folder is made when missing), flushes that file to the disk
/// and renames it to `path`. When anything fails the temporary file is removed and `path` is as it was.
/// Throws EnvironmentError naming `path` (disk full, no permission) or what `write` throws. Refused is a path that leaves a
/// folder that it has gone into ("out/../x"), as a second lock: names are checked where they are read.
void write_aside(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

/// The same for bytes at hand.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The bytes of a file; throws EnvironmentError naming it when it cannot be read. For files of ours: see read_input().
std::string read_file(const std::filesystem::path& path);

/// The bytes of a file that a person named: a regular one of at most `most` bytes; no device or pipe keeps us waiting.
/// Throws InputError about `where` and `key`.
std::string read_input(const std::filesystem::path& path, std::uint64_t most, const Location& where = {},
                       const std::string& key = {});

/// Makes a folder and those above it; throws EnvironmentError naming it. Refuses what write_aside() refuses.
void make_folder(const std::filesystem::path& path);

/// Removes what dead processes of this machine left of write_aside() in `folder`, with what they had beside it
/// (".NAME.OWNER.part", ".NAME.OWNER.part.html", ...), not in folders below. OWNER says machine, boot, process and when
/// that began: what belongs to a process that lives, or may live (of another machine), stays.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace dem

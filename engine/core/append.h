#pragma once
// Files that grow by whole lines, also when several processes write at once or one of them is killed.
#include <filesystem>
#include <string>
#include <string_view>

namespace dem {

/// Holds a lock on a file, which is made when missing, for as long as this lives; others wait.
class FileLock {
 public:
  /// Throws EnvironmentError naming the path.
  explicit FileLock(const std::filesystem::path& path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  /// Appends `line` and a line end to the locked file, whole or not at all; half a line of a process that died is taken away
  /// first. Throws EnvironmentError.
  void append(std::string_view line);

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

/// The same for one line.
inline void append_line(const std::filesystem::path& path, std::string_view line) { FileLock(path).append(line); }

}  // namespace dem

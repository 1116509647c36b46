#include "engine/core/append.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace dem {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw EnvironmentError("cannot write " + path.string() + ": " + std::strerror(errno));
}

/// Where the last whole line ends.
off_t end_of_lines(int file, const std::filesystem::path& path) {
  off_t end = ::lseek(file, 0, SEEK_END);
  if (end < 0) fail(path);
  std::array<char, 4096> block;
  while (end > 0) {
    const off_t from = end > static_cast<off_t>(block.size()) ? end - static_cast<off_t>(block.size()) : 0;
    const ssize_t count = ::pread(file, block.data(), static_cast<std::size_t>(end - from), from);
    if (count != end - from) fail(path);
    for (ssize_t i = count; i > 0; --i) {
      if (block[static_cast<std::size_t>(i - 1)] == '\n') return from + i;
    }
    end = from;
  }
  return 0;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& path) : path_(path) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) fail(path);
  while (::flock(file_, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    const int code = errno;
    ::close(file_);
    errno = code;
    fail(path);
  }
}

FileLock::~FileLock() { ::close(file_); }

void FileLock::append(std::string_view line) {
  const off_t end = end_of_lines(file_, path_);
  if (::ftruncate(file_, end) != 0) fail(path_);
  const std::string whole = std::string(line) + "\n";
  std::size_t done = 0;
  while (done < whole.size()) {
    const ssize_t count = ::pwrite(file_, whole.data() + done, whole.size() - done, end + static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int code = errno;
      (void)!::ftruncate(file_, end);
      errno = code;
      fail(path_);
    }
    done += static_cast<std::size_t>(count);
  }
  if (::fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail(path_);
}

}  // namespace dem

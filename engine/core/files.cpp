#include "engine/core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "engine/core/errors.h"

namespace dem {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int code) {
  throw EnvironmentError("cannot " + what + " " + path.string() + ": " + std::strerror(code));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

/// An empty file with a name of its own beside `path`, so that processes and threads that share a folder do not meet.
/// (mkstemp() would make it for one user only, and to ask for the mask of the others is to change it for all threads.)
fs::path reserve(const fs::path& path) {
  const std::string head = "." + path.filename().string() + "." + std::to_string(::getpid()) + "-";
  for (int number = 0;; ++number) {
    fs::path part = path.parent_path() / (head + std::to_string(number) + ".part");
    const Descriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() >= 0) return part;
    if (errno != EEXIST) fail(path, "write", errno);
  }
}

void flush(const fs::path& path, const fs::path& target) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(target, "write", errno);
  // Some file systems cannot flush (EINVAL, ENOTSUP); a full disk (EIO, ENOSPC) must be heard.
  if (::fsync(file.get()) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail(target, "write", errno);
}

}  // namespace

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  const fs::path part = reserve(path);
  try {
    write(part);
    flush(part, path);
    std::error_code error;
    fs::rename(part, path, error);
    if (error) throw EnvironmentError("cannot write " + path.string() + ": " + error.message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_aside(path, [&](const fs::path& part) {
    const Descriptor file(::open(part.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (file.get() < 0) fail(path, "write", errno);
    while (!bytes.empty()) {
      const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path, "write", errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  });
}

std::string read_file(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, "read", errno);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (true) {
    const ssize_t count = ::read(file.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "read", errno);
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error)) {
    throw EnvironmentError("cannot make the folder " + path.string() + ": " +
                           (error ? error.message() : std::string("a file of that name is in the way")));
  }
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::error_code ignored;
    if (name.starts_with(".") && name.ends_with(".part")) fs::remove(at->path(), ignored);
  }
}

}  // namespace dem

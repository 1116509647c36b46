#include "engine/core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "engine/core/errors.h"
#include "engine/core/hash.h"

namespace dem {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int code) {
  std::string why = std::strerror(code);
  if (code == EFBIG) why += "; files may not grow larger here (ulimit -f)";
  throw EnvironmentError("cannot " + what + " " + path.string() + ": " + why);
}

bool has_nul(const fs::path& path) { return path.native().find('\0') != std::string::npos; }

/// ".." at the start leads to a folder that was asked for; after a name it leads out of that one.
bool leaves_its_folder(const fs::path& path) {
  bool gone_in = false;
  for (const fs::path& part : path) {
    if (part == ".." && gone_in) return true;
    gone_in = gone_in || (part != ".." && part != "." && !part.empty() && part != path.root_path());
  }
  return has_nul(path);
}

void refuse_to_leave(const fs::path& path) {
  if (leaves_its_folder(path)) throw EnvironmentError("will not write " + path.string() + ": it leaves its folder");
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

std::string first_line(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// When a process began, in ticks since the boot: with it a number that is given again is told from the first. "": there
/// is no such process, or it has ended and nobody has asked how: after a kill that takes the parent too, the first process
/// of the machine does, some time later.
std::string beginning_of(pid_t process) {
  const std::string line = first_line(("/proc/" + std::to_string(process) + "/stat").c_str());
  std::size_t at = line.rfind(')');  // the second field, the name, may hold anything
  const std::size_t ended = at + 2;  // the third: the state
  for (int field = 2; field < 21 && at != std::string::npos; ++field) at = line.find(' ', at + 1);
  if (at == std::string::npos) {
    return ::kill(process, 0) == 0 || errno == EPERM ? "0" : "";  // no /proc: the number has to do
  }
  if (line[ended] == 'Z' || line[ended] == 'X') return "";
  return line.substr(at + 1, line.find(' ', at + 1) - at - 1);
}

/// Who writes a temporary file.
struct Owner {
  std::string machine;  // of its name and its id
  std::string boot;     // of the running kernel and of the processes that see each other
  pid_t process = 0;
  std::string beginning;  // of the process
};

const Owner& this_machine() {
  static const Owner owner = [] {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = 0;
    std::error_code ignored;
    const std::string processes = fs::read_symlink("/proc/self/ns/pid", ignored).string();
    return Owner{sha256(host.data() + std::string("\n") + first_line("/etc/machine-id")).substr(0, 8),
                 sha256(first_line("/proc/sys/kernel/random/boot_id") + "\n" + processes).substr(0, 8),
                 0,
                 {}};
  }();
  return owner;
}

/// The part of a temporary name that stands between the file's own name and the number.
std::string owner_text() {
  const Owner& here = this_machine();
  const pid_t process = ::getpid();  // asked each time: pictures are drawn in forked processes
  return here.machine + "-" + here.boot + "-" + std::to_string(process) + "-" + beginning_of(process);
}

/// ".NAME.MACHINE-BOOT-PROCESS-BEGINNING-NUMBER.part" and what follows on ".part"; nothing for other names.
std::optional<Owner> owner_of(const std::string& name) {
  const std::size_t end = name.rfind(".part");
  if (!name.starts_with(".") || end == std::string::npos) return {};
  if (end + 5 != name.size() && name[end + 5] != '.') return {};
  const std::size_t begin = name.rfind('.', end - 1) + 1;
  std::array<std::string, 5> parts;
  std::size_t at = begin;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t stop = std::min(i + 1 < parts.size() ? name.find('-', at) : end, end);
    parts[i] = name.substr(at, stop - at);
    if (parts[i].empty() || at > end) return {};
    at = stop + 1;
  }
  Owner owner{parts[0], parts[1], 0, parts[3]};
  const auto [stop, wrong] = std::from_chars(parts[2].data(), parts[2].data() + parts[2].size(), owner.process);
  if (wrong != std::errc{} || *stop != 0 || owner.process <= 0) return {};
  return owner;
}

/// True only when no process can be at work on it any more.
bool is_dead(const Owner& owner, const fs::path& path) {
  const Owner& here = this_machine();
  if (owner.machine != here.machine) return false;
  if (owner.boot == here.boot) return beginning_of(owner.process) != owner.beginning;
  // Of an earlier boot, or of a container that is gone; one that runs beside this one writes now.
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::hours(24);
}

/// An empty file with a name of its own beside `path`, so that processes and threads that share a folder do not meet.
/// (mkstemp() would make it for one user only, and to ask for the mask of the others is to change it for all threads.)
fs::path reserve(const fs::path& path) {
  const std::string head = "." + path.filename().string() + "." + owner_text() + "-";
  constexpr int tries = 1000;
  for (int number = 0; number < tries; ++number) {
    fs::path part = path.parent_path() / (head + std::to_string(number) + ".part");
    const Descriptor file(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() >= 0) return part;
    if (errno != EEXIST) fail(path, "write", errno);
  }
  throw EnvironmentError("cannot write " + path.string() + ": a thousand names of temporary files beside it (" + head +
                         "0.part, ...) are taken; remove them");
}

void flush(const fs::path& path, const fs::path& target) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(target, "write", errno);
  // Some file systems cannot flush (EINVAL, ENOTSUP); a full disk (EIO, ENOSPC) must be heard.
  if (::fsync(file.get()) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail(target, "write", errno);
}

}  // namespace

fs::path inside(const fs::path& folder, const fs::path& name) {
  const bool up = std::find(name.begin(), name.end(), fs::path("..")) != name.end();
  if (name.empty() || name.has_root_path() || up || has_nul(name)) {
    throw EnvironmentError("will not write " + name.string() + ": it lies outside " + folder.string());
  }
  return folder / name;
}

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  refuse_to_leave(path);
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

std::string read_input(const fs::path& path, std::uint64_t most, const Location& where, const std::string& key) {
  const auto refuse = [&](const std::string& wrong, const std::string& right) {
    throw InputError(where, key, wrong, right);
  };
  const std::string name = where.file == path.string() ? "the file" : path.string();
  // Without O_NONBLOCK the opening of a pipe waits for a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat facts {};
  if (has_nul(path) || file.get() < 0 || ::fstat(file.get(), &facts) != 0) {
    refuse("cannot read " + path.string() + ": " + std::strerror(has_nul(path) ? EINVAL : errno),
           "give a file that you may read");
  }
  if (!S_ISREG(facts.st_mode)) {
    refuse(name + " is no plain file but a folder, a pipe or a device", "give the path of a file with text");
  }
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  if (size > most) {
    refuse(name + " has " + std::to_string(size) + " bytes",
           "at most " + std::to_string(most) + " are read; is it the right file?");
  }
  // No more than it has now: some that say 0 (/proc/kmsg) never end.
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + have, bytes.size() - have);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      refuse("cannot read " + path.string() + ": " + std::strerror(errno), "give a file that you may read");
    if (count == 0) break;
    have += static_cast<std::size_t>(count);
  }
  bytes.resize(have);
  return bytes;
}

void make_folder(const fs::path& path) {
  refuse_to_leave(path);
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
    const std::optional<Owner> owner = owner_of(at->path().filename().string());
    std::error_code ignored;
    if (owner && is_dead(*owner, at->path())) fs::remove(at->path(), ignored);
  }
}

}  // namespace dem

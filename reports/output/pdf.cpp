#include "reports/output/pdf.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace reports {
namespace {

constexpr const char* fixed_date = "SOURCE_DATE_EPOCH=1609459200";  // 2021-01-01: any fixed moment would do

/// A file that is gone when this goes.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {}
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<char*> environment() {
  std::vector<char*> variables;
  for (char** item = environ; *item; ++item) variables.push_back(*item);
  if (!std::getenv("SOURCE_DATE_EPOCH")) variables.push_back(const_cast<char*>(fixed_date));
  variables.push_back(nullptr);
  return variables;
}

// WeasyPrint names pictures in the PDF by their address: this one is the same wherever the report lies.
constexpr const char* fixed_base = "file:///proc/self/cwd/";

// Runs weasyprint in `folder`, with its messages in `log`; returns its exit status.
int run_weasyprint(const std::string& folder, const std::string& html, const std::string& style, const std::string& pdf,
                   const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  std::array<std::string, 11> words{"weasyprint", "--pdf-variant", "pdf/ua-1", "--encoding", "utf-8", "--base-url",
                                    fixed_base,   "--stylesheet",  style,      html,         pdf};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "weasyprint", &actions, nullptr, arguments.data(), environment().data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) {
    throw dem::EnvironmentError(
        "weasyprint is not installed: it prints the PDF; install the Debian package weasyprint, "
        "or ask for the page alone with --format html");
  }
  if (failed != 0) throw dem::EnvironmentError(std::string("weasyprint cannot be started: ") + std::strerror(failed));
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw dem::EnvironmentError(std::string("waiting for weasyprint failed: ") + std::strerror(errno));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// WeasyPrint goes on after errors and ends with 0: its log tells.
std::string errors_in(const std::string& log) {
  std::istringstream lines(log);
  std::string errors;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ERROR") || line.starts_with("CRITICAL")) errors += (errors.empty() ? "" : "; ") + line;
  }
  return errors;
}

}  // namespace

std::string without_file_links(std::string html) {
  for (const std::string_view target : {" href=\"figures/", " href=\"data/"}) {
    for (std::size_t at = html.find(target); at != std::string::npos; at = html.find(target, at)) {
      html.erase(at, html.find('"', at + target.size()) + 1 - at);
    }
  }
  return html;
}

void print_pdf(const std::string& html, const std::filesystem::path& print_style, const std::filesystem::path& pdf) {
  if (!std::filesystem::exists(print_style)) {
    throw dem::EnvironmentError("the style sheet " + print_style.string() + " is missing");
  }
  dem::write_aside(pdf, [&](const std::filesystem::path& aside) {
    const Temporary source(aside.string() + ".html");
    const Temporary log(aside.string() + ".log");
    dem::write_file(source.path(), without_file_links(html));
    const auto whole = [](const std::filesystem::path& path) { return std::filesystem::absolute(path).string(); };
    const int status = run_weasyprint(whole(aside).substr(0, whole(aside).find_last_of('/')), whole(source.path()),
                                      whole(print_style), whole(aside), whole(log.path()));
    const std::string messages = dem::read_file(log.path());
    const std::string errors = errors_in(messages);
    if (!errors.empty()) throw dem::EnvironmentError("weasyprint could not print the report: " + errors);
    if (status != 0) {
      throw dem::EnvironmentError("weasyprint ended with status " + std::to_string(status) + ": " +
                                  messages.substr(messages.size() - std::min<std::size_t>(messages.size(), 400)));
    }
  });
}

}  // namespace reports

#include "tests/cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "engine/core/files.h"
#include "tests/support/scratch.h"

namespace test {

namespace {

Outcome run(const std::filesystem::path& folder, std::vector<std::string> words, const WhileRunning& meanwhile) {
  const Scratch logs;
  const std::string out = logs / "out";
  const std::string err = logs / "err";
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    const int null = ::open("/dev/null", O_RDONLY);
    const int to_out = ::open(out.c_str(), O_WRONLY | O_CREAT, 0600);
    const int to_err = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
    const bool ready =
        ::chdir(folder.c_str()) == 0 && ::dup2(null, 0) >= 0 && ::dup2(to_out, 1) >= 0 && ::dup2(to_err, 2) >= 0;
    if (ready) ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  if (meanwhile) meanwhile(child);
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("lost a process");
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, dem::read_file(out), dem::read_file(err)};
}

}  // namespace

Outcome run_program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const WhileRunning& meanwhile) {
  std::vector<std::string> words = {DEM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run(folder, words, meanwhile);
}

Outcome run_shell(const std::filesystem::path& folder, const std::string& script) {
  return run(folder, {"/bin/sh", "-c", "PROGRAM=" DEM_PROGRAM "\n" + script}, {});
}

std::vector<int> children_of(int process) {
  std::vector<int> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string line;
    if (!std::getline(file, line)) continue;
    std::istringstream rest(line.substr(line.rfind(')') + 1));
    char state = 0;
    int parent = 0;
    if (rest >> state >> parent && parent == process && state != 'Z') {
      children.push_back(std::stoi(entry.path().filename().string()));
    }
  }
  return children;
}

bool wait_until(const std::function<bool()>& holds, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace test

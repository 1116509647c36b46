#include "tests/cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "engine/core/files.h"
#include "tests/support/scratch.h"

namespace test {

Outcome run_program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const WhileRunning& meanwhile) {
  const Scratch logs;
  const std::string out = logs / "out";
  const std::string err = logs / "err";
  std::vector<std::string> words = {DEM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
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

}  // namespace test

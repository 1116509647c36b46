// What is said to Slurm and how its answers are read; other programs started by their words.
#include <doctest/doctest.h>

#include <algorithm>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/cluster/process.h"
#include "reports/cluster/slurm.h"
#include "tests/support/scratch.h"

namespace {

using Texts = std::vector<std::string>;

bool holds(const Texts& words, const std::string& word) { return std::ranges::find(words, word) != words.end(); }

}  // namespace

TEST_CASE("a program gets its words as they are, and gives back what it says") {
  const Texts odd = {"a b", "$(touch HARM)", "`x`", "\"", "'", "*", "", "\\", "\xe9"};
  Texts words = {"/usr/bin/printf", "<%s>"};
  words.insert(words.end(), odd.begin(), odd.end());
  std::string expected;
  for (const std::string& word : odd) expected += "<" + word + ">";
  const cluster::Said said = cluster::run_words(words);
  CHECK(said.code == 0);
  CHECK(said.out == expected);
  CHECK(said.err.empty());
  CHECK(cluster::run_words({"sh", "-c", "echo wrong >&2; exit 7"}).code == 7);
  CHECK(cluster::run_words({"sh", "-c", "echo wrong >&2; exit 7"}).err == "wrong\n");
  CHECK(cluster::run_words({"sh", "-c", "kill -9 $$"}).code == 137);
  CHECK(cluster::run_words({"there-is-no-such-program"}).code == 127);
  CHECK(cluster::run_words({"sleep", "100"}, [] { return true; }).code == 137);
}

TEST_CASE("--sbatch is taken apart by blanks and quotes, and nothing in it is obeyed") {
  const auto split = [](const char* text) { return cluster::split_words(text, "--sbatch"); };
  CHECK(split("") == Texts{});
  CHECK(split("  --account=rock\t--qos=long ") == Texts{"--account=rock", "--qos=long"});
  CHECK(split("--comment='two words' -p \"it's\" a\\ b ''") == Texts{"--comment=two words", "-p", "it's", "a b", ""});
  CHECK(split("$(touch x) `y` *") == Texts{"$(touch", "x)", "`y`", "*"});
  CHECK_THROWS_WITH_AS(split("--comment='open"), "--sbatch: the quote ' is not closed; close it", dem::InputError);
}

TEST_CASE("sbatch is told folder, log, threads, memory, order and the user's own options, a word each") {
  const cluster::Submission submission{.folder = "/home/a b/50% of $(x)",
                                       .program = "/opt/pro gram/dem-report",
                                       .output = "/home/a b",
                                       .first = 1001,
                                       .count = 37,
                                       .threads = 4,
                                       .memory = std::uint64_t{3} << 30,
                                       .after = {"12", "13"},
                                       .partition = "long; rm -rf /",
                                       .time_limit = "0:20:00",
                                       .more = {"--account=rock"}};
  const Texts words = cluster::sbatch_words(submission);
  CHECK(words.front() == "sbatch");
  for (const char* word :
       {"--array=0-36", "--cpus-per-task=4", "--mem=3072M", "--requeue", "--dependency=afterany:12:13",
        "--time=0:20:00", "--partition=long; rm -rf /", "--chdir=/home/a b/50% of $(x)",
        "--output=/home/a b/50%% of $(x)/log/%A_%a.txt",  // % is %% there
        "--signal=B:USR1@120"}) {
    CAPTURE(word);
    CHECK(holds(words, word));
  }
  CHECK(Texts(words.end() - 5, words.end()) ==
        Texts{"--account=rock", "/home/a b/50% of $(x)/job.sh", "/opt/pro gram/dem-report", "/home/a b", "1001"});
  cluster::Submission plain{.folder = "/x", .program = "/p", .output = "/o", .time_limit = "1"};
  CHECK(holds(cluster::sbatch_words(plain), "--signal=B:USR1@15"));  // of a minute, a quarter
  CHECK(std::ranges::none_of(cluster::sbatch_words(plain), [](const auto& w) { return w.starts_with("--dep"); }));
  plain.folder = "/back\\slash";  // no patterns there
  CHECK(holds(cluster::sbatch_words(plain), "--output=/back\\\\slash/log/all.txt"));
  CHECK(cluster::log_of("/back\\slash", "7", 1) == "/back\\slash/log/all.txt");
  CHECK(cluster::log_of("/x", "7", 1) == "/x/log/7_1.txt");
}

TEST_CASE("the job script is one that sh can read") {
  const test::Scratch folder;
  dem::write_file(folder / "job.sh", cluster::job_script());
  CHECK(cluster::run_words({"sh", "-n", (folder / "job.sh").string()}).code == 0);
}

TEST_CASE("answers of Slurm") {
  CHECK(cluster::max_array_size_in("JobRequeue              = 1\nMaxArraySize            = 501\n") == 501);
  CHECK(cluster::max_array_size_in("nothing of the kind") == 1001);
  const cluster::Queue queue =
      cluster::queue_in("12|0|RUNNING|None\n12|3|PENDING|Dependency\n13|N/A|RUNNING|None\nnonsense\n");
  CHECK(queue.size() == 2);
  CHECK(queue.at({"12", 3}).state == "PENDING");
  CHECK(queue.at({"12", 3}).reason == "Dependency");
}

TEST_CASE("time limits as sbatch takes them") {
  const auto seconds = [](const char* text) { return cluster::seconds_of_limit(text).value_or(-1); };
  CHECK(seconds("90") == 5400);
  CHECK(seconds("2:30") == 150);
  CHECK(seconds("1:00:30") == 3630);
  CHECK(seconds("1-12") == 129600);
  CHECK(seconds("1-12:30") == 131400);
  CHECK(seconds("0-0:0:7") == 7);
  for (const char* wrong : {"", "x", "1:", "1:2:3:4", "-5", "1-", "4h", "1.5"}) {
    CAPTURE(wrong);
    CHECK_FALSE(cluster::seconds_of_limit(wrong));
  }
}

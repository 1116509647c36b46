#pragma once
// What is said to Slurm, and what it answers: scontrol, sbatch, squeue. Never sacct: many sites keep no accounts.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cluster {

/// The largest number of elements of a job array here. Throws dem::EnvironmentError when there is no Slurm, or when it does not
/// answer.
std::size_t max_array_size();
/// MaxArraySize of what `scontrol show config` says; 1001, Slurm's own default, when it does not say.
std::size_t max_array_size_in(std::string_view config);

/// "90" (minutes), "2:30" (minutes, seconds), "1:00:00", "1-12", "1-12:30", "1-12:30:00" in seconds; nothing for other texts.
std::optional<double> seconds_of_limit(std::string_view text);

struct Submission {
  std::filesystem::path folder = {};   ///< of the run: manifest, packs, job.sh, logs; the jobs work there
  std::filesystem::path program = {};  ///< dem-report
  std::filesystem::path output = {};   ///< absolute
  std::size_t first = 0;               ///< pack of the array's element 0
  std::size_t count = 1;
  int threads = 1;
  std::uint64_t memory = 0;             ///< bytes
  std::vector<std::string> after = {};  ///< jobs that must have ended, however
  std::string partition = {};           ///< "": the site's
  std::string time_limit = {};          ///< as the user wrote it; "": the site's
  std::vector<std::string> more = {};   ///< further words for sbatch; they win over ours
};

/// The words of sbatch, the program first: what is in the names of files goes as it is.
std::vector<std::string> sbatch_words(const Submission& submission);

/// The number of the job. Throws dem::EnvironmentError with what sbatch said.
std::string submit(const Submission& submission);

/// The script that every job runs. It is the same for all: its words are program, output folder and first pack.
std::string_view job_script();

/// Where an element of an array says what it says.
std::filesystem::path log_of(const std::filesystem::path& folder, const std::string& job, std::size_t element);

struct Element {
  std::string state;   ///< "PENDING", "RUNNING", "COMPLETING", ...
  std::string reason;  ///< why it waits: "Resources", "Dependency", "JobHeldUser"
};

/// Jobs of this user that are not over, by number of the array and of the element.
using Queue = std::map<std::pair<std::string, std::size_t>, Element>;

/// Nothing when Slurm does not answer (its controller is being restarted): then nothing is known.
std::optional<Queue> queue(const std::function<bool()>& stopped);
Queue queue_in(std::string_view squeue);  ///< of what squeue says

}  // namespace cluster

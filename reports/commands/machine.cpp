#include "reports/commands/machine.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "engine/core/errors.h"

namespace cli {

std::string host_name() {
  std::string host(256, '\0');
  if (gethostname(host.data(), host.size() - 1) != 0) host.clear();
  host.resize(std::char_traits<char>::length(host.c_str()));
  return host;
}

std::uint64_t memory_bytes() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void require_weasyprint() {
  const char* path = std::getenv("PATH");
  const std::string folders = path ? path : "";
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t colon = std::min(folders.find(':', from), folders.size());
    const std::filesystem::path program = std::filesystem::path(folders.substr(from, colon - from)) / "weasyprint";
    if (access(program.c_str(), X_OK) == 0) return;
    from = colon + 1;
  }
  throw dem::EnvironmentError(
      "the PDF needs WeasyPrint, which is not installed: run 'apt-get install weasyprint', or leave the PDF out with "
      "--format html");
}

}  // namespace cli

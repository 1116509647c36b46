#include "reports/commands/machine.h"

#include <unistd.h>

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

}  // namespace cli

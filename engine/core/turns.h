#pragma once
// One at a time per name: of cases that run side by side and need the same thing, the first makes it, the others wait
// for it.
#include <map>
#include <mutex>
#include <string>

namespace dem {

class Turns {
 public:
  /// Waits until nobody else holds `name`; it is held for as long as the lock lives.
  [[nodiscard]] std::unique_lock<std::mutex> take(const std::string& name) { return std::unique_lock(mutex_of(name)); }

 private:
  std::mutex& mutex_of(const std::string& name) {
    const std::lock_guard lock(all_);
    return names_[name];
  }

  std::mutex all_;
  std::map<std::string, std::mutex> names_;
};

}  // namespace dem

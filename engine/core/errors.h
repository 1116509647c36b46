#pragma once
// Errors that a person can act on. The exit code of the program follows from the type:
// InputError 2, EnvironmentError 3, anything else 3 (a defect of ours).
#include <stdexcept>
#include <string>

namespace dem {

/// Where in the user's input something is wrong. `line` and `column` start at 1; 0: unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Something the user wrote is wrong: says where, which key, what is wrong and what would be right.
class InputError : public std::runtime_error {
 public:
  InputError(Location where, std::string key, const std::string& wrong, std::string right)
      : std::runtime_error(compose(where, key, wrong, right)),
        where_(std::move(where)),
        key_(std::move(key)),
        wrong_(wrong),
        right_(std::move(right)) {}
  explicit InputError(const std::string& wrong, std::string right = {})
      : InputError(Location{}, {}, wrong, std::move(right)) {}

  [[nodiscard]] const Location& where() const { return where_; }
  [[nodiscard]] const std::string& key() const { return key_; }
  [[nodiscard]] const std::string& wrong() const { return wrong_; }
  [[nodiscard]] const std::string& right() const { return right_; }

 private:
  // "file:line:column: key: what is wrong; what would be right"
  static std::string compose(const Location& where, const std::string& key, const std::string& wrong,
                             const std::string& right) {
    std::string text;
    if (!where.file.empty()) {
      text += where.file;
      if (where.line > 0) text += ":" + std::to_string(where.line);
      if (where.column > 0) text += ":" + std::to_string(where.column);
      text += ": ";
    }
    if (!key.empty()) text += key + ": ";
    text += wrong;
    if (!right.empty()) text += "; " + right;
    return text;
  }
  Location where_;
  std::string key_;
  std::string wrong_;
  std::string right_;
};

/// The machine is in the way (disk full, a tool missing, no GL context): exit code 3.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A case that could not be simulated (its specimen cannot be packed, the solution blew up).
/// The report is still made, with this text in the place of the case's figures: exit code 1.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dem

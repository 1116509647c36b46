#pragma once
// What was given to a command, checked against its declaration.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct Command;

/// Asking for something that the command does not declare is a defect of ours: std::logic_error.
class Arguments {
 public:
  using Texts = std::vector<std::string>;
  using Named = std::map<std::string, Texts, std::less<>>;

  /// All values in the order in which they were given; defaults are put in here.
  Arguments(const Command& command, Named given, Named words);

  [[nodiscard]] bool has(std::string_view option) const;                     ///< given by the user
  [[nodiscard]] const std::string& text(std::string_view option) const;      ///< the value or its default; "": neither
  [[nodiscard]] const Texts& texts(std::string_view option) const;           ///< of a repeatable option, or of a list
  [[nodiscard]] std::uint64_t number(std::string_view option) const;         ///< of an option that has a value
  [[nodiscard]] const Texts& words(std::string_view positional) const;       ///< as many as were given
  [[nodiscard]] const std::string& word(std::string_view positional) const;  ///< the first one; "": none

 private:
  struct Value {
    bool given = false;
    Texts texts{};
  };
  std::map<std::string, Value, std::less<>> values_;
  Named words_;
  [[nodiscard]] const Value& value(std::string_view option) const;
};

/// "html,pdf" -> "html", "pdf"; an empty text is one empty part.
std::vector<std::string> parts_of(std::string_view list);

}  // namespace cli

#include "reports/commands/arguments.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "reports/commands/command.h"

namespace cli {
namespace {

const std::string nothing;

[[noreturn]] void undeclared(std::string_view what) {
  throw std::logic_error("the command does not declare " + std::string(what));
}

}  // namespace

Arguments::Arguments(const Command& command, Named given, Named words) : words_(std::move(words)) {
  for (const Option& option : command.options) {
    Value value;
    if (const auto at = given.find(option.name); at != given.end()) {
      value = {true, std::move(at->second)};
    } else if (!option.standard.empty()) {
      value.texts = {option.standard};
    }
    if (option.kind == OptionKind::list && !value.texts.empty()) value.texts = parts_of(value.texts.back());
    values_.emplace(option.name, std::move(value));
  }
  for (const Positional& positional : command.positionals) words_.try_emplace(positional.name);
}

const Arguments::Value& Arguments::value(std::string_view option) const {
  const auto at = values_.find(option);
  if (at == values_.end()) undeclared("--" + std::string(option));
  return at->second;
}

bool Arguments::has(std::string_view option) const { return value(option).given; }

const std::string& Arguments::text(std::string_view option) const {
  const Texts& all = value(option).texts;
  return all.empty() ? nothing : all.back();
}

const Arguments::Texts& Arguments::texts(std::string_view option) const { return value(option).texts; }

std::uint64_t Arguments::number(std::string_view option) const {
  const std::string& digits = text(option);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) undeclared("a number as " + std::string(option));
  return number;
}

const Arguments::Texts& Arguments::words(std::string_view positional) const {
  const auto at = words_.find(positional);
  if (at == words_.end()) undeclared(positional);
  return at->second;
}

const std::string& Arguments::word(std::string_view positional) const {
  const Texts& all = words(positional);
  return all.empty() ? nothing : all.front();
}

std::vector<std::string> parts_of(std::string_view list) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    parts.emplace_back(list.substr(from, comma - from));
    from = comma + 1;
  }
  return parts;
}

}  // namespace cli

#include "reports/overview/for_ci.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/text.h"
#include "reports/text.h"

namespace overview {
namespace {

constexpr std::size_t most_markdown = 58'000;

/// Characters that XML 1.0 does not allow are seen as dem::printable() shows them.
std::string xml(const std::string& text) {
  std::string all;
  for (const char c : dem::printable(text, true)) {
    switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '>':
        all += "&gt;";
        break;
      case '"':
        all += "&quot;";
        break;
      case '\n':
        all += "&#10;";
        break;
      default:
        all += c;
    }
  }
  return all;
}

enum class End { well, failure, error, skipped };

/// The test cases of one suite, counted as they come.
class Suite {
 public:
  explicit Suite(const StudyRow& row) : row_(row) {}

  void add(const std::string& kind, const std::string& name, End end, const std::string& message,
           const std::string& out = {}, double seconds = 0) {
    ++tests_;
    std::string inside;
    if (end == End::failure) inside += fmt::format("      <failure message=\"{}\" type=\"{}\"/>\n", xml(message), kind);
    if (end == End::error) inside += fmt::format("      <error message=\"{}\" type=\"{}\"/>\n", xml(message), kind);
    if (end == End::skipped) inside += fmt::format("      <skipped message=\"{}\"/>\n", xml(message));
    if (!out.empty()) inside += "      <system-out>" + xml(out) + "</system-out>\n";
    failures_ += end == End::failure ? 1 : 0;
    errors_ += end == End::error ? 1 : 0;
    skipped_ += end == End::skipped ? 1 : 0;
    cases_ += fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\"", xml(row_.folder), kind,
                          xml(name), seconds);
    cases_ += inside.empty() ? "/>\n" : ">\n" + inside + "    </testcase>\n";
  }

  [[nodiscard]] std::string text() const {
    return fmt::format(
               "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n",
               xml(row_.folder), tests_, failures_, errors_, skipped_, row_.seconds) +
           cases_ + "  </testsuite>\n";
  }
  [[nodiscard]] int tests() const { return tests_; }
  [[nodiscard]] int failures() const { return failures_; }
  [[nodiscard]] int errors() const { return errors_; }

 private:
  const StudyRow& row_;
  int tests_ = 0, failures_ = 0, errors_ = 0, skipped_ = 0;
  std::string cases_;
};

Suite suite_of(const StudyRow& row, bool strict) {
  Suite suite(row);
  suite.add("study", "could run", row.error.empty() ? End::well : End::error, row.error);
  for (const CaseOf& one : row.cases) {
    suite.add("case", one.id, one.error.empty() ? End::well : End::failure, one.error, {}, one.seconds.value_or(0));
  }
  for (const CheckOf& check : row.checks) {
    const std::string value = check.value ? reports::number(*check.value, 3) : "no number";
    suite.add("check", check.id, check.held ? End::well : End::failure,
              fmt::format("{}, limit {}", value, reports::number(check.limit, 3)));
  }
  if (row.since_state == "unreadable") suite.add("reference", "can be read", End::failure, row.since);
  if (row.since_state == "new") suite.add("reference", "there is one", End::skipped, "new: nothing was accepted yet");
  for (const ChangeOf& change : row.changes) {
    const std::string text = change.text.empty() ? change.state : change.text;
    suite.add("reference", change.id, change.alarms ? End::failure : End::well, text,
              change.alarms || change.state == "same" ? "" : change.state + ": " + text);
  }
  for (const PublishedOf& published : row.published) {
    const bool fails = strict && published.verdict == "missed";
    const std::string text = published.verdict + ": " + published.text + " (" + published.source + ")";
    suite.add("published", published.id, fails ? End::failure : End::well, text, text);
  }
  return suite;
}

/// In a cell of a table.
std::string cell(const std::string& text) {
  std::string all;
  for (const char c : dem::printable(text)) {
    if (c == '|' || c == '<' || c == '*' || c == '_' || c == '`' || c == '[') all += '\\';
    all += c;
  }
  return all;
}

}  // namespace

std::string junit(const std::vector<StudyRow>& rows, bool strict) {
  int tests = 0, failures = 0, errors = 0;
  double seconds = 0;
  std::string suites;
  for (const StudyRow& row : rows) {
    const Suite suite = suite_of(row, strict);
    tests += suite.tests();
    failures += suite.failures();
    errors += suite.errors();
    seconds += row.seconds;
    suites += suite.text();
  }
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"dem-report\" tests=\"{}\" failures=\"{}\" "
             "errors=\"{}\" time=\"{:.3f}\">\n",
             tests, failures, errors, seconds) +
         suites + "</testsuites>\n";
}

std::string markdown(const std::vector<StudyRow>& rows) {
  const auto in_state = [&](const char* state) {
    return std::ranges::count_if(rows, [&](const StudyRow& row) { return row.state() == state; });
  };
  std::string text = fmt::format("## {} studies: {} failed, {} changed, {} well\n\n", rows.size(), in_state("failed"),
                                 in_state("changed"), in_state("well"));
  text += "| study | state | verdict |\n|---|---|---|\n";
  std::size_t left_out = 0;
  const auto add = [&](const std::string& more) {
    if (text.size() + more.size() > most_markdown) {
      ++left_out;
      return;
    }
    text += more;
  };
  for (const StudyRow& row : rows) {
    const std::string state = row.state() == "well" ? "well" : "**" + row.state() + "**";
    std::string verdict = row.verdict();
    if (verdict.size() > 600) verdict = verdict.substr(0, verdict.find(' ', 590)) + " ...";
    add(fmt::format("| {} | {} | {} |\n", cell(row.folder), state, cell(verdict)));
  }
  for (const StudyRow& row : rows) {
    if (row.state() == "well") continue;
    std::string part = fmt::format("\n### {}\n\n", cell(row.folder));
    if (!row.error.empty()) part += "- could not run: " + cell(row.error) + "\n";
    for (const CaseOf& one : row.cases) {
      if (!one.error.empty()) part += fmt::format("- case {} failed: {}\n", cell(one.id), cell(one.error));
    }
    for (const CheckOf& check : row.checks) {
      if (!check.held) part += fmt::format("- check {} is broken\n", cell(check.id));
    }
    for (const std::string& cause : row.causes) part += "- why: " + cell(cause) + "\n";
    constexpr std::size_t most = 30;
    std::size_t shown = 0;
    for (const ChangeOf& change : row.changes) {
      if (!change.alarms) continue;
      if (++shown <= most)
        part += fmt::format("- {}: {}\n", cell(change.id), cell(change.text.empty() ? change.state : change.text));
    }
    if (shown > most) part += fmt::format("- and {} more\n", shown - most);
    add(part);
  }
  if (left_out > 0) text += fmt::format("\n{} parts more are on the page index.html.\n", left_out);
  return text;
}

std::string github_annotation(const std::string& file, int line, int column, const std::string& message) {
  const auto escaped = [](const std::string& text, bool property) {
    std::string all;
    for (const char c : text) {
      const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
      all += special ? fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c))) : std::string(1, c);
    }
    return all;
  };
  std::string place;
  if (!file.empty()) place += " file=" + escaped(file, true);
  if (!file.empty() && line > 0) place += fmt::format(",line={}", line);
  if (!file.empty() && line > 0 && column > 0) place += fmt::format(",col={}", column);
  return "::error" + place + "::" + escaped(message, false);
}

}  // namespace overview

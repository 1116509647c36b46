#include "reports/output/pdf.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/output/child.h"

namespace reports {
namespace {

constexpr const char* fixed_date = "SOURCE_DATE_EPOCH=1609459200";  // 2021-01-01: any fixed moment would do

/// A file that is gone when this goes.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {}
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<std::string> environment() {
  std::vector<std::string> variables;
  for (char** item = environ; *item; ++item) variables.emplace_back(*item);
  if (!std::getenv("SOURCE_DATE_EPOCH")) variables.emplace_back(fixed_date);
  return variables;
}

// WeasyPrint names pictures in the PDF by their address: this one is the same wherever the report lies.
constexpr const char* fixed_base = "file:///proc/self/cwd/";
constexpr const char* program_name = "weasyprint";

std::string in_folders(const std::string& folders) {
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t colon = std::min(folders.find(':', from), folders.size());
    const std::string folder = colon > from ? folders.substr(from, colon - from) : ".";
    const std::string program = (std::filesystem::absolute(folder) / program_name).string();
    if (access(program.c_str(), X_OK) == 0 && !std::filesystem::is_directory(program)) {
      return program;
    }
    from = colon + 1;
  }
  return {};
}

std::string usual_folders() {
  std::string folders(confstr(_CS_PATH, nullptr, 0), '\0');
  confstr(_CS_PATH, folders.data(), folders.size());
  return folders.c_str();
}

// Without PATH (env -i) programs are where the system has them.
std::string find_weasyprint() {
  const char* path = std::getenv("PATH");
  const std::string usual = usual_folders();
  std::string found = in_folders(path ? path : usual);
  if (!found.empty()) return found;
  found = in_folders(usual);
  if (!found.empty()) {
    throw dem::EnvironmentError("the PDF needs WeasyPrint, which is " + found +
                                ", but PATH does not name that folder: add it to PATH, or leave the PDF out with "
                                "--format html");
  }
  throw dem::EnvironmentError(
      "the PDF needs WeasyPrint, and no folder of PATH holds it: run 'apt-get install weasyprint', or leave the PDF "
      "out "
      "with --format html");
}

std::string last_words(const std::string& said) {
  constexpr std::size_t most = 400;
  std::string words = said.substr(said.size() - std::min(said.size(), most));
  words = words.substr(std::min(words.find_first_not_of(" \n\r\t"), words.size()));
  words.erase(words.find_last_not_of(" \n\r\t") + 1);
  return words.empty() ? "; it said nothing" : "; it said last: " + harmless(words);
}

[[noreturn]] void no_font() {
  throw dem::EnvironmentError(
      "weasyprint found no font: fontconfig knows none; install the package fonts-dejavu-core, or look at "
      "FONTCONFIG_FILE and FONTCONFIG_PATH");
}

// Without a font Pango crashes or waits for ever, and its last words do not say why.
void check_fonts(const std::string& said) {
  if (said.find("No fonts configured") != std::string::npos) no_font();
}

// What fontconfig knows, if its tool is there to tell.
void check_fonts() {
  const std::unique_ptr<FILE, int (*)(FILE*)> fonts(
      popen("command -v fc-list >/dev/null || echo untold; timeout 20 fc-list 2>/dev/null", "r"), pclose);
  if (fonts && std::fgetc(fonts.get()) == EOF) no_font();
}

std::string signal_text(int signal) {
  return std::string("signal ") + std::to_string(signal) + " (" + strsignal(signal) + ")" +
         (signal == SIGKILL ? ", as a machine does that is out of memory" : "");
}

// WeasyPrint goes on after errors and ends with 0: its log tells.
std::string errors_in(const std::string& log) {
  std::istringstream lines(log);
  std::string errors;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ERROR") || line.starts_with("CRITICAL"))
      errors += (errors.empty() ? "" : "; ") + harmless(line);
  }
  return errors;
}

}  // namespace

std::string harmless(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f) text[i] = ' ';
    const bool high_control = byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (high_control) text[i] = text[i + 1] = ' ';
  }
  return text;
}

std::string fault_of_pdf(std::string_view bytes) {
  if (bytes.empty()) return "it is empty";
  if (!bytes.starts_with("%PDF-")) return "it does not begin like a PDF";
  const std::size_t last = bytes.find_last_not_of(" \n\r\t");
  const std::string_view tail = bytes.substr(0, last + 1);
  if (!tail.ends_with("%%EOF")) return "it ends too early";
  const std::size_t table = tail.rfind("startxref");
  if (table == std::string_view::npos || std::strtoull(&tail[table] + 9, nullptr, 10) >= table) {
    return "its table of contents is missing";
  }
  if (bytes.find("/ObjStm") != std::string_view::npos) return {};  // pages are packed: they cannot be counted
  for (const std::string_view mark : {"/Type /Page", "/Type/Page"}) {
    for (std::size_t at = bytes.find(mark); at != std::string_view::npos; at = bytes.find(mark, at + 1)) {
      const std::size_t after = at + mark.size();
      if (after >= bytes.size() || std::isalpha(static_cast<unsigned char>(bytes[after])) == 0) return {};
    }
  }
  return "it has no page";
}

void check_printing() {
  (void)find_weasyprint();
  check_fonts();
  const char* date = std::getenv("SOURCE_DATE_EPOCH");
  if (!date) return;
  const std::string_view digits = date;
  constexpr std::size_t most_digits = 11;  // the year 5138: Python's calendar ends with the year 9999
  if (digits.empty() || digits.size() > most_digits || digits.find_first_not_of("0123456789") != std::string::npos) {
    throw dem::EnvironmentError(
        "the environment variable SOURCE_DATE_EPOCH is '" + harmless(std::string(digits)) +
        "', and the date in the PDF is taken from it: let it be a whole number of seconds since "
        "1970, or unset it");
  }
}

void print_pdf(const std::string& html, const std::filesystem::path& print_style, const std::filesystem::path& pdf,
               const PrintLimits& limits) {
  if (!std::filesystem::exists(print_style)) {
    throw dem::EnvironmentError("the style sheet " + print_style.string() + " is missing");
  }
  check_printing();
  dem::write_aside(pdf, [&](const std::filesystem::path& aside) {
    const Temporary source(aside.string() + ".html");
    const Temporary log(aside.string() + ".log");
    dem::write_file(source.path(), html);
    const auto whole = [](const std::filesystem::path& path) { return std::filesystem::absolute(path).string(); };
    const ChildEnd end =
        run_child({.path = find_weasyprint(),
                   .words = {"--pdf-variant", "pdf/ua-1", "--encoding", "utf-8", "--base-url", fixed_base,
                             "--stylesheet", whole(print_style), whole(source.path()), whole(aside)},
                   .environment = environment(),
                   .folder = whole(aside).substr(0, whole(aside).find_last_of('/')),
                   .log = whole(log.path())},
                  limits.seconds, limits.stopped);
    const bool spoke = std::filesystem::exists(log.path());
    const std::string said = spoke ? dem::read_file(log.path()) : "";
    if (end.late) {
      throw dem::EnvironmentError("weasyprint was still printing after " +
                                  std::to_string(static_cast<long long>(limits.seconds)) +
                                  " s and was ended: allow more with --pdf-timeout SECONDS, or leave the PDF out with "
                                  "--format html" +
                                  last_words(said));
    }
    check_fonts(said);
    if (end.signal != 0) {
      throw dem::EnvironmentError("weasyprint was ended by " + signal_text(end.signal) + last_words(said));
    }
    const std::string errors = errors_in(said);
    if (!errors.empty()) throw dem::EnvironmentError("weasyprint could not print the report: " + errors);
    if (end.code != 0) {
      throw dem::EnvironmentError("weasyprint ended with status " + std::to_string(end.code) + last_words(said));
    }
    const std::string fault = fault_of_pdf(dem::read_file(aside));
    if (!fault.empty()) {
      throw dem::EnvironmentError("weasyprint ended well but left no whole PDF: " + fault + last_words(said));
    }
  });
}

}  // namespace reports

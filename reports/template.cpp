#include "reports/template.h"

#include <regex>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace reports {
namespace {

std::string valid_text(const std::filesystem::path& file) {
  std::string text = dem::read_file(file);
  if (const kainjow::mustache::mustache pattern(text); !pattern.is_valid()) {
    throw dem::EnvironmentError("the page template " + file.filename().string() +
                                " is broken: " + pattern.error_message());
  }
  return text;
}

}  // namespace

std::string fill_template(const std::filesystem::path& file, PageData data) {
  const std::string text = valid_text(file);
  const std::regex named(R"(\{\{>\s*(\w+)\s*\}\})");
  for (std::sregex_iterator part(text.begin(), text.end(), named), end; part != end; ++part) {
    const std::string name = (*part)[1];
    std::string shared = valid_text(file.parent_path() / "parts" / (name + ".html"));
    if (shared.ends_with('\n')) shared.pop_back();  // the line that names it has its own
    data.set(name, PageData(kainjow::mustache::partial([shared] { return shared; })));
  }
  return kainjow::mustache::mustache(text).render(data);
}

}  // namespace reports

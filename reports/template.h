#pragma once
// Page templates (assets/page), in Mustache.
#include <filesystem>
#include <string>

#include <kainjow/mustache.hpp>

namespace reports {

/// Data of a template; names of fields are the names in the template.
using PageData = kainjow::mustache::data;

/// The template `file`, filled. What templates share lies beside it: {{> NAME}} is parts/NAME.html, filled with the same
/// data. Throws EnvironmentError when the file or a part that it names is missing or broken.
[[nodiscard]] std::string fill_template(const std::filesystem::path& file, PageData data);

}  // namespace reports

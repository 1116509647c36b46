#pragma once
// Where the page template, the style sheets and the published numbers lie.
#include <filesystem>
#include <string>

namespace cli {

/// The folder that DEM_REPORT_ASSETS names; when that is not set, the one that was installed with the program, else the
/// one beside the program (a build folder has a link there). Throws dem::EnvironmentError that names all places tried.
std::filesystem::path assets_folder();

/// The same for a given value of DEM_REPORT_ASSETS ("": not set) and a given executable.
std::filesystem::path assets_folder(const std::string& asked, const std::filesystem::path& program);

}  // namespace cli

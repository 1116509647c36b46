#pragma once
// PDF (PDF/UA-1) from the page, printed by WeasyPrint.
#include <filesystem>
#include <string>

namespace reports {

/// Prints `html` with the style sheet `print_style` for paged media to `pdf`, written aside and renamed. Pictures may be
/// named relative to the PDF's folder. Links to files beside the page are left out of the PDF: they would name the folder
/// of this machine. SOURCE_DATE_EPOCH is set to a fixed value when it is not set, so that bytes repeat.
/// Throws dem::EnvironmentError when weasyprint is missing, fails, or logs an error.
void print_pdf(const std::string& html, const std::filesystem::path& print_style, const std::filesystem::path& pdf);

/// `html` without the targets of links to figures/ and data/.
std::string without_file_links(std::string html);

}  // namespace reports

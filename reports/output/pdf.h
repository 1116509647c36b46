#pragma once
// PDF (PDF/UA-1) from the page, printed by WeasyPrint.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace reports {

struct PrintLimits {
  double seconds = 900;                                  ///< WeasyPrint is ended after so long
  std::function<bool()> stopped = [] { return false; };  ///< asked while it prints
};

/// Prints `html` with the style sheet `print_style` for paged media to `pdf`, written aside, looked at and renamed.
/// Pictures may be named relative to the PDF's folder. SOURCE_DATE_EPOCH is set to a fixed value when it is not set, so that bytes repeat.
/// Throws dem::EnvironmentError when weasyprint is missing, fails, logs an error, takes too long or leaves something that
/// is no whole PDF; dem::Interrupted when asked to stop.
void print_pdf(const std::string& html, const std::filesystem::path& print_style, const std::filesystem::path& pdf,
               const PrintLimits& limits = {});

/// What keeps WeasyPrint from being started, found before anything is simulated: throws dem::EnvironmentError when it is
/// not there, saying how to get it or how to do without, or when SOURCE_DATE_EPOCH is no date.
void check_printing();

/// What is wrong with the bytes of a PDF; "" when it has its head, its end and at least one page.
std::string fault_of_pdf(std::string_view bytes);

/// `text` for a terminal: control characters are blanks.
std::string harmless(std::string text);
}  // namespace reports

#pragma once
// Texts of people: UTF-8 taken apart, and what has no place in a name, a page or a terminal.
#include <cstddef>
#include <string>
#include <string_view>

namespace dem {

/// One character of a UTF-8 text.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 1;  ///< that it takes
  bool valid = false;     ///< else `code` is the first byte
};

/// The character at the start of `text`, which is not empty.
Character first_character(std::string_view text);

bool is_utf8(std::string_view text);

/// The number of characters; a byte that is no UTF-8 counts as one.
std::size_t length_of(std::string_view text);

/// Characters that are not seen but act: controls (ESC, NUL, line ends), marks that turn the direction of writing, and
/// those without width.
bool is_control(char32_t code);

/// Whether it may stand in a name: a letter or a digit, of Latin, Greek, Cyrillic or other living scripts.
bool is_letter_or_digit(char32_t code);

/// "ESC" as "\x1b" and so on, so that a message may go to a terminal; line ends stay when `lines`.
std::string printable(std::string_view text, bool lines = false);

}  // namespace dem

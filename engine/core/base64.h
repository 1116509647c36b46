#pragma once
// Base64, for pictures inside a page.
#include <string>
#include <string_view>

namespace dem {

/// `bytes` in the alphabet of RFC 4648, section 4, padded, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace dem

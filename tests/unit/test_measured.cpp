// Values as laboratories write them, with their uncertainty.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/core/errors.h"
#include "engine/scenario/measured.h"

namespace {

dem::Measured stress(std::string_view text) { return dem::read_measured(text, "MPa"); }

std::string refused(std::string_view text, std::string_view unit = "MPa", std::string_view at = {}) {
  try {
    (void)dem::read_measured(text, unit, at);
  } catch (const dem::InputError& error) {
    return std::string(error.wrong()) + " | " + std::string(error.right());
  }
  return {};
}

}  // namespace

TEST_CASE("a value with its standard deviation, as laboratories write it") {
  for (const char* text : {"210 MPa +- 8", "210 +- 8 MPa", "210 MPa ± 8 MPa", "210 ± 8 MPa", "210 MPa +/- 8",
                           "210MPa+-8", "0.21 GPa +- 8 MPa", "210 N/mm2 \u00b1 8"}) {
    CAPTURE(text);
    const dem::Measured found = stress(text);
    CHECK(found.value == doctest::Approx(2.1e8).epsilon(1e-12));
    CHECK(found.deviation == doctest::Approx(8e6).epsilon(1e-12));
    CHECK(found.low == doctest::Approx(2.02e8).epsilon(1e-12));
    CHECK(found.high == doctest::Approx(2.18e8).epsilon(1e-12));
  }
  CHECK(stress("200 MPa +- 4 %").deviation == doctest::Approx(8e6));
  CHECK(dem::read_measured("0.26 +- 0.02", "").deviation == doctest::Approx(0.02));
  CHECK(dem::read_measured("1e-1 +- 2e-2", "").value == doctest::Approx(0.1));
}

TEST_CASE("a range is its middle, and its half width over root 3") {
  for (const char* text : {"200-228 MPa", "200 - 228 MPa", "200 to 228 MPa", "200 MPa - 228 MPa", "200\u2013228 MPa"}) {
    CAPTURE(text);
    const dem::Measured found = stress(text);
    CHECK(found.value == doctest::Approx(2.14e8));
    CHECK(found.low == doctest::Approx(2e8));
    CHECK(found.high == doctest::Approx(2.28e8));
    CHECK(found.deviation == doctest::Approx(14e6 / std::sqrt(3.0)));
  }
  CHECK(dem::read_measured("0.22-0.30", "").value == doctest::Approx(0.26));
  CHECK(dem::read_measured("9e-2-1.1e-1", "").value == doctest::Approx(0.1));
}

TEST_CASE("a value alone has no uncertainty") {
  const dem::Measured found = stress("210 MPa");
  CHECK(found.value == 2.1e8);
  CHECK(found.low == found.high);
  CHECK(found.is_certain());
}

TEST_CASE("of a list each says at which pressure") {
  const dem::Measured found = dem::read_measured("320 MPa +- 10 at 20 MPa", "MPa", "MPa");
  CHECK(found.value == doctest::Approx(3.2e8));
  CHECK(found.at == doctest::Approx(2e7));
  CHECK(dem::read_measured("300-340 MPa at 200 bar", "MPa", "MPa").at == doctest::Approx(2e7));
  CHECK(refused("320 MPa +- 10", "MPa", "MPa").find("at which confining pressure") != std::string::npos);
  CHECK(refused("320 MPa +- 10 at 20 MPa").find("does not take") != std::string::npos);
}

TEST_CASE("what is not such a value is refused with what would be right") {
  CHECK(refused("210").find("has no unit") != std::string::npos);
  CHECK(refused("210 mm +- 8").find("units of length") != std::string::npos);
  CHECK(refused("210 MPa +- 8 mm").find("units of length") != std::string::npos);
  CHECK(refused("210 MPa +-").find("lacks a number") != std::string::npos);
  CHECK(refused("+- 8 MPa").find("lacks a number") != std::string::npos);
  CHECK(refused("210 MPa +- 0").find("no uncertainty") != std::string::npos);
  CHECK(refused("228-200 MPa").find("does not go up") != std::string::npos);
  CHECK(refused("210,5 MPa +- 8").find("comma") != std::string::npos);
  CHECK(refused("much").find("MPa") != std::string::npos);
  CHECK(refused("0.26 MPa", "").find("without unit") != std::string::npos);
  CHECK(refused("much").find("| write") != std::string::npos);
}

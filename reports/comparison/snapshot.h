#pragma once
// What a comparison looks at: the numbers, curves, pictures and words of one study, read from the folder of a report or from
// a reference. Both give the same shape; of a reference, curves and pictures are reduced.
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image.h"

namespace comparison {

/// A report or reference that cannot be compared, and why, for a person: cut short, of an older format, not there.
struct Unreadable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct StudyCase {
  std::string id;
  std::string content{};  ///< see dem::Record; "" when there is no record
  std::string error{};    ///< why there is none
};

enum class FactKind { result, check, published };

/// A number of summary.json with what stands beside it.
struct Fact {
  FactKind kind = FactKind::result;
  std::string id;      ///< "results/compression_ar_1/young_modulus"
  std::string name{};  ///< "Young’s modulus, compression_ar_1"
  std::string unit{};
  std::vector<double> numbers{};  ///< one; two for a range; none when it could not be computed
  std::string words{};            ///< "held" or "broken"; the verdict; a result that is a text
};

/// A curve, or a column of a table, of a CSV file.
struct Curve {
  std::string key;   ///< the words of its rows: "σ₃ 10 MPa"; "" when there are none
  std::string x, y;  ///< heads of its columns
  std::vector<std::pair<double, double>> points{};
  double within = 0;  ///< how far what was left out may lie from it, as a share of its range
};

struct DataFile {
  std::string file;  ///< "data/crack_maps.csv"
  std::string sha256{};
  std::filesystem::path path{};  ///< of the whole file; empty: a reference
  std::vector<Curve> reduced{};  ///< of a reference
};

struct Picture {
  std::string id;               ///< "figures/crack_maps_ar_1": PNG and SVG of that name are one picture
  std::string title{};          ///< of its figure
  std::filesystem::path png{};  ///< the picture; of a reference the reduced one, or none
  std::filesystem::path svg{};  ///< the drawing, where there is one
  std::string pixels{};         ///< SHA-256 of the decoded pixels; "": not known yet
  std::string drawing{};        ///< SHA-256 of the SVG without its facts; "": none
  int factor = 1;               ///< of the reduced one: a pixel is the mean of so many times so many
};

/// The words of a part of the page, numbers replaced by "#".
struct Passage {
  std::string section;
  std::vector<std::string> lines{};
};

struct Snapshot {
  std::string scenario, scale;
  bool reduced = false;  ///< read from a reference
  std::vector<StudyCase> cases{};
  std::vector<Fact> facts{};
  std::vector<DataFile> data{};
  std::vector<Picture> pictures{};
  std::vector<Passage> text{};

  [[nodiscard]] std::string name() const { return scenario + "." + scale; }
};

/// Of the folder of a report (out/NAME.SCALE). `page` is the page when report.html is not written yet; its words are those
/// of report.html when it is empty. Throws Unreadable.
Snapshot read_report(const std::filesystem::path& folder, const std::string& page = {});

bool is_report(const std::filesystem::path& folder);

enum class Detail {
  fine,       ///< within 0.05 % of the range, up to 400 points: for two reports
  reference,  ///< within 0.1 %, up to 64 points of five digits: what a reference keeps
};
/// The curves of a data file: those of a reference as they are, else read and reduced.
std::vector<Curve> curves_of(const DataFile& file, Detail detail);

/// The SHA-256 of the decoded pixels of a picture, "" when it has none. Throws Unreadable.
std::string pixels_of(const Picture& picture);

/// The curves of a CSV text, whole: rows with the same words are one group; its first column of numbers is x.
std::vector<Curve> curves_of_csv(std::string_view text);

/// The curve with as few points as it needs; `within` says how near they stay.
Curve reduced(const Curve& curve, Detail detail);

/// The words of a page by sections, without what is compared as numbers or says how the page was made.
std::vector<Passage> words_of(std::string_view html);

/// SVG without its <metadata>, which names the version of the program.
std::string without_facts(std::string svg);

}  // namespace comparison

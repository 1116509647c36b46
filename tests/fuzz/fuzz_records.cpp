// Records, specimens and checkpoints, damaged: each is refused unless it is whole. Where nothing guards the bytes, that is
// behind a checkpoint's sum, they are read as far as they make sense.
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "engine/core/archive.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/store/store.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/scratch.h"

namespace {

struct Part {
  std::int64_t step = 0;
  std::vector<double> place;
  std::vector<std::string> words;
  std::vector<std::vector<std::int32_t>> lists;
  template <class Archive>
  void archive(Archive& a) {
    a(step, place, words, lists);
  }
};
struct State {
  std::vector<Part> parts;
  std::string name;
  std::vector<std::uint8_t> bits;
  template <class Archive>
  void archive(Archive& a) {
    a(parts, name, bits);
  }
};

State state() {
  State made;
  made.parts.resize(2);
  made.parts[0] = {7, {1, 2, 3}, {"a", "", "words"}, {{1, 2}, {}, {3}}};
  made.name = "state";
  made.bits = {0, 1, 1};
  return made;
}

dem::Record record() {
  static const dem::Quantity none[] = {{.id = "unused", .name = "Unused"}};
  dem::Record made;
  made.model = "sheet", made.scenario = "fuzz", made.case_id = "case", made.content = "seed = 1\n";
  made.physics_version = "sheet 9";
  made.quantities = none;
  made.parameters = {{"test", std::string("compression")}, {"aspect_ratio", 2.0}};
  made.checks.push_back({"energy", 0.1, 0.2, true, "what it means"});
  made.notes = {"A note."};
  dem::Table table;
  table.name = "snapshots/0000";
  table.attributes = {{"strain", "0.1"}};
  table.add("stress", "MPa", std::vector<double>{1, 2, 3});
  made.tables.push_back(table);
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  const test::Scratch scratch;
  const std::filesystem::path file = scratch / "file";
  std::vector<std::string> corpus;
  dem::write_record(record(), file);
  corpus.push_back(dem::read_file(file));
  dem::write_tables(file, {{"key", "value"}}, record().tables);
  corpus.push_back(dem::read_file(file));
  dem::save_checkpoint(file, "seed = 1\n", state());
  corpus.push_back(dem::read_file(file));
  dem::ArchiveWriter bare;
  bare(state());
  corpus.push_back(bare.bytes());
  const std::vector<std::string> whole = corpus;

  dem_fuzz::Harness harness{"records",
                            corpus,
                            {"sha256 ", "dem-report checkpoint 1\n", std::string(8, '\0'), std::string(8, '\xff'),
                             std::string("\x08\0\0\0\0\0\0\0", 8), "\x89HDF\r\n\x1a\n"},
                            {},
                            [&](const std::string& input) {
                              std::ofstream(file, std::ios::binary | std::ios::trunc) << input;
                              const auto reads = [&](const auto& attempt, const std::string& due, const char* what) {
                                try {
                                  attempt();
                                } catch (const dem::EnvironmentError&) {
                                  return false;
                                }
                                if (input != due) throw std::logic_error(std::string("damaged ") + what + " was read");
                                return true;
                              };
                              bool read = reads([&] { (void)dem::read_record(file); }, whole[0], "record");
                              (void)reads([&] { (void)dem::read_content(file); }, whole[0], "content");
                              read = reads([&] { (void)dem::read_tables(file); }, whole[1], "tables") || read;
                              State kept = state();
                              if (dem::load_checkpoint(file, "seed = 1\n", kept).loaded) {
                                if (input != whole[2]) throw std::logic_error("a damaged checkpoint was read");
                                read = true;
                              }
                              try {
                                dem::ArchiveReader reader(input);
                                reader(kept);
                              } catch (const dem::ArchiveMismatch&) {
                              }
                              if (!read) throw dem::EnvironmentError("refused");
                            }};
  return dem_fuzz::run(argc, argv, harness);
}

#pragma once
// Reads what nobody meant: inputs of a corpus, changed at random, through one reader. An input may be read or be refused
// with an InputError or an EnvironmentError; anything else, a reader that computes longer than 20 s, and whatever the
// sanitizers find is a defect, and its input is kept. Input i of a seed is the same on every machine. Every other input is
// changed mildly: numbers keep their kind and size, lines go, other lines come, so that much of it is read and what lies behind
// the reader is reached.
//
//   fuzz_NAME [INPUTS [SEED]]    so many inputs (10 000), of seed 1
//   fuzz_NAME FILE               this one
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dem_fuzz {

struct Harness {
  std::string name;
  std::vector<std::string> corpus;               ///< inputs that are well, or nearly
  std::vector<std::string> words;                ///< put in now and then
  std::vector<std::string> lines;                ///< that leave an input well, or nearly: added at its end
  std::function<void(const std::string&)> read;  ///< throws what the reader throws
};

/// The files of a folder below tests/fuzz/corpus, by name.
std::vector<std::string> corpus(const std::string& folder);

int run(int argc, char** argv, const Harness& harness);

}  // namespace dem_fuzz

#pragma once
// Ends that main() does not see: signals that kill for a closed pipe or a file's size, exceptions that leave a parallel
// region, libraries that end the program. The exit code is 3 all the same, and a sentence says why.
namespace cli {

/// To be called first in main(). From then on:
/// - writing to a pipe that nobody reads, or beyond the limit on a file's size, is an error of the call and no end;
/// - an exception that leaves an OpenMP region or a thread (out of memory, most of all) ends the program with 3. It cannot
///   be carried on behind the region: the other threads wait at its barriers. The last checkpoint is kept;
/// - a library that calls exit(), as libgomp does when it can make no thread, ends the program with 3.
void prepare_last_words();

/// To be called last in main(): the exit that follows is ours. Returns `code`.
int leave_with(int code);

}  // namespace cli

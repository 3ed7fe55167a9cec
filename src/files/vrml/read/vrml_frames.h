#pragma once
#include <cstdint>

namespace icome::files {

/// Messages between the reader of designs and the process that parses VRML (icome-vrml-worker), over its
/// standard input and output: frames, each a head and then `size` bytes. Both run on one machine and come
/// from one build, so that numbers are sent as they are in memory.
enum class VrmlFrame : std::uint32_t {
  Limits,   // to the worker, first: a VrmlLimits
  Name,     // to the worker: the path of file `file`; then follows File
  File,     // to the worker: the content of file `file`; the first is the design itself, file 0
  Known,    // to the worker, for a Fetch: it is file `file`, which the worker has
  Refused,  // to the worker, for a Fetch: why there is none, a sentence
  Fetch,    // from the worker: the file that one of these urls in file `file` means, zeros between them
  Answer,   // from the worker, last: a Scene of vrml_answer.fbs
};

struct VrmlFrameHead {
  VrmlFrame kind = VrmlFrame::Limits;
  std::int32_t file = 0;
  std::uint64_t size = 0;
};

struct VrmlLimits {
  std::uint64_t memory = 0;  // bytes, beside those of the program itself
  double seconds = 0.0;
  std::int64_t parent = 0;  // process id of the reader: the worker ends with it
};

/// Exit codes of a worker that cannot answer any more.
inline constexpr int kVrmlOutOfMemory = 101;
inline constexpr int kVrmlTooDeep = 102;
inline constexpr int kVrmlBadFrame = 103;

}  // namespace icome::files

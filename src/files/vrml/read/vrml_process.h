#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "files/design.h"

namespace icome::files {

/// The answer of the process that parses VRML. It cannot be trusted at all: a file may have taken control
/// of the parser.
struct VrmlAnswer {
  std::string bytes;                         // a Scene of vrml_answer.fbs, not verified
  std::vector<std::filesystem::path> files;  // read for it: `path` and all that it inlines, links resolved
  std::uint64_t inlined_bytes = 0;           // of the latter
};

/// Has the VRML 2.0 file `bytes`, which lies at `path`, parsed by a process of its own (icome-vrml-worker,
/// beside the running program or at the path in the environment variable ICOME_VRML_WORKER), since no
/// parser is proof against files made to break it: it has limits on memory (options.memory_limit, else
/// those of a MemoryBudget with the files that it gets) and time, can open nothing, and gets the inlined
/// files from here, by the rules of url_policy.h and only if they are VRML. Fails, naming the file, when
/// that process needs too much, crashes, breaks the protocol or is not installed; a file that it refuses is
/// an answer (Scene.error). The caller's process is left as it was: no process, descriptor or signal
/// handler stays. Blocks; may be called from several threads.
base::Result<VrmlAnswer> ask_vrml_worker(std::string_view bytes, const std::filesystem::path& path,
                                         const DesignReadOptions& options = {});

}  // namespace icome::files

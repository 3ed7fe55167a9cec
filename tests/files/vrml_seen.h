#pragma once
// Talking to the process that parses VRML, for tests.
#include <gtest/gtest.h>
#include <vrml_answer_generated.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/vrml/read/vrml_process.h"

namespace icome::files {

/// An answer that a verifier has seen.
class SeenAnswer {
 public:
  explicit SeenAnswer(const base::Result<VrmlAnswer>& answer) {
    if (!answer) {
      failure = answer.error().message;
      return;
    }
    bytes_ = answer->bytes;
    const auto* begin = reinterpret_cast<const std::uint8_t*>(bytes_.data());
    flatbuffers::Verifier verifier(begin, bytes_.size(), 64, 50'000'000);
    if (flat::VerifySceneBuffer(verifier))
      scene_ = flat::GetScene(begin);
    else
      failure = "the answer is no Scene";
  }

  std::string failure = {};  // of the process; empty: it answered
  const flat::Scene& scene() const { return *scene_; }
  const flat::Scene* operator->() const { return scene_; }
  bool is_scene() const { return scene_ != nullptr; }
  /// Why the file was refused, by the process or in its answer; empty: it was read.
  std::string refusal() const {
    if (!scene_) return failure;
    return scene_->error() ? scene_->error()->str() : "";
  }
  /// All notes, as "file:line: text\n".
  std::string notes() const {
    std::string all;
    if (!scene_ || !scene_->notes()) return all;
    for (const flat::Note* note : *scene_->notes())
      all += (note->file() ? std::filesystem::path(note->file()->str()).filename().string() : "") + ":" +
             std::to_string(note->line()) + ": " + (note->text() ? note->text()->str() : "") + "\n";
    return all;
  }

 private:
  std::string bytes_ = {};
  const flat::Scene* scene_ = nullptr;
};

/// What is made of this text, with the header put before it, as if it lay in the folder of temporary files.
inline SeenAnswer ask_about(const std::string& text, const DesignReadOptions& options = {}) {
  return SeenAnswer(ask_vrml_worker("#VRML V2.0 utf8\n" + text,
                                    std::filesystem::path(testing::TempDir()) / "t.wrl", options));
}

}  // namespace icome::files

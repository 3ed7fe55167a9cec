#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "files/design_files.h"
#include "study/definition/study_reader.h"
#include "study/definition/templates.h"

namespace icome::study {

/// A template of `icome study new` with its scenes, in a folder that goes with it.
class TemplateFolder {
 public:
  explicit TemplateFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("icome-study-" + std::to_string(::getpid()) + "-" + name)),
        text_(study_template(name, name).value()),
        study_(read_study(text_, name).value()) {
    for (const TemplateScene& scene : template_scenes(name)) {
      std::filesystem::create_directories((path_ / scene.file).parent_path());
      std::ofstream(path_ / scene.file) << scene.text;
    }
  }
  ~TemplateFolder() { std::filesystem::remove_all(path_); }
  TemplateFolder(const TemplateFolder&) = delete;
  TemplateFolder& operator=(const TemplateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::string& text() const { return text_; }
  const Study& study() const { return study_; }
  world::World scene(const std::string& file) const {
    auto design = files::read_design(path_ / "scenes" / file);
    if (!design) throw std::runtime_error(design.error().message);
    return std::move(design->world);
  }

 private:
  std::filesystem::path path_;
  std::string text_;
  Study study_;
};

}  // namespace icome::study

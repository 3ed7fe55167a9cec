#pragma once
#include <cstdint>
#include <string>

#include "apps/study/scene_pictures.h"
#include "base/result.h"
#include "study/analysis/analysis.h"

namespace icome::apps {

/// The purpose of a page: a browser (pictures of lines), or ui::write_pdf(), whose HTML is simpler.
enum class PageForm : std::uint8_t { Screen, Paper };

/// The report of a study: one page of XHTML that needs nothing else. Words of people are text in it, never
/// markup; where data are simulated every caption says so.
std::string study_page(const study::StudyData& data, const study::Analysis& analysis, PageForm form,
                       const std::vector<ScenePicture>& scenes = {});

/// The results as JSON: study, simulated, participants, tables, correlations, those of the thesis, questions,
/// hypotheses, checks, warnings.
std::string study_page_json(const study::StudyData& data, const study::Analysis& analysis);

/// The key results, for a terminal.
std::string study_page_text(const study::StudyData& data, const study::Analysis& analysis);

}  // namespace icome::apps

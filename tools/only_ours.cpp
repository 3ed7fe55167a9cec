// A plug-in of clang-tidy: its checks look at what the project declares, not at the libraries that it
// includes.
//
// clang-tidy 16 looks at every declaration of Eigen, GoogleTest and the standard library, and at all that
// their templates are made into, only to leave out what it finds there. That takes longer than reading the
// sources does.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchers.h>
#include <clang/Basic/SourceManager.h>

#include <vector>

namespace {

namespace matchers = clang::ast_matchers;
namespace tidy = clang::tidy;

/// Finds nothing itself. A translation unit is matched before what is in it, so that it can still be told
/// which of its declarations to go through.
class OnlyOurs final : public tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;

  void registerMatchers(matchers::MatchFinder* finder) override {
    finder->addMatcher(matchers::translationUnitDecl().bind("unit"), this);
  }

  void check(const matchers::MatchFinder::MatchResult& found) override {
    std::vector<clang::Decl*> ours;
    for (clang::Decl* declaration : found.Nodes.getNodeAs<clang::TranslationUnitDecl>("unit")->decls()) {
      if (!found.SourceManager->isInSystemHeader(declaration->getLocation())) ours.push_back(declaration);
    }
    found.Context->setTraversalScope(ours);
  }
};

class Module final : public tidy::ClangTidyModule {
 public:
  void addCheckFactories(tidy::ClangTidyCheckFactories& factories) override {
    factories.registerCheck<OnlyOurs>("icome-only-ours");
  }
};

const tidy::ClangTidyModuleRegistry::Add<Module> kAdded("icome",
                                                        "Looks at the project's own declarations only.");

}  // namespace

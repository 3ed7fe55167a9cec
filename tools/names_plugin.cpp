// A plug-in of clang that runs the checks of clang-tidy (names above all, by .clang-tidy) while a source is
// compiled, on what the project declares.
//
// clang-tidy reads every source again, with Eigen, Qt and the standard library, which takes nearly all of its
// time; and clang-tidy 16 then goes through all that these declare, only to leave out what it finds there.
#include <clang-tidy/ClangTidy.h>
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyDiagnosticConsumer.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang-tidy/ClangTidyOptions.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchers.h>
#include <clang/Basic/SourceManager.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/FrontendPluginRegistry.h>
#include <clang/Frontend/MultiplexConsumer.h>

#include <memory>
#include <utility>
#include <vector>

namespace {

namespace matchers = clang::ast_matchers;
namespace tidy = clang::tidy;

constexpr const char* kOnlyOurs = "icome-only-ours";

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
    factories.registerCheck<OnlyOurs>(kOnlyOurs);
  }
};

const tidy::ClangTidyModuleRegistry::Add<Module> kModule("icome",
                                                         "Looks at the project's own declarations only.");

/// Each file is held to the table above it, as by clang-tidy itself.
std::unique_ptr<tidy::ClangTidyOptionsProvider> options() {
  tidy::ClangTidyOptions added;
  added.Checks = kOnlyOurs;
  return std::make_unique<tidy::FileOptionsProvider>(tidy::ClangTidyGlobalOptions(), tidy::ClangTidyOptions(),
                                                     added);
}

/// The checks of one translation unit and what they find. The checks point into the factory and the context.
struct Checks {
  Checks() { context.setDiagnosticsEngine(&engine); }

  tidy::ClangTidyContext context{options()};
  tidy::ClangTidyASTConsumerFactory factory{context};
  tidy::ClangTidyDiagnosticConsumer findings{context};
  clang::DiagnosticsEngine engine{new clang::DiagnosticIDs, new clang::DiagnosticOptions, &findings, false};
};

/// Makes an error of each finding, once the checks have run.
class Reporter final : public clang::ASTConsumer {
 public:
  Reporter(std::unique_ptr<Checks> checks, clang::DiagnosticsEngine& compiler)
      : checks_(std::move(checks)), compiler_(compiler) {}

  void HandleTranslationUnit(clang::ASTContext& unit) override {
    const unsigned id = compiler_.getCustomDiagID(clang::DiagnosticsEngine::Error, "%0 [%1]");
    for (const tidy::ClangTidyError& finding : checks_->findings.take())
      compiler_.Report(place(unit.getSourceManager(), finding.Message), id)
          << finding.Message.Message << finding.DiagnosticName;
  }

 private:
  static clang::SourceLocation place(const clang::SourceManager& sources,
                                     const clang::tooling::DiagnosticMessage& message) {
    const auto file = sources.getFileManager().getFile(message.FilePath);
    if (!file) return {};
    return sources.getComposedLoc(sources.translateFile(*file), message.FileOffset);
  }

  std::unique_ptr<Checks> checks_;
  clang::DiagnosticsEngine& compiler_;
};

class Action final : public clang::PluginASTAction {
 public:
  std::unique_ptr<clang::ASTConsumer> CreateASTConsumer(clang::CompilerInstance& compiler,
                                                        llvm::StringRef file) override {
    auto checks = std::make_unique<Checks>();
    std::vector<std::unique_ptr<clang::ASTConsumer>> in_order;
    in_order.push_back(checks->factory.createASTConsumer(compiler, file));
    in_order.push_back(std::make_unique<Reporter>(std::move(checks), compiler.getDiagnostics()));
    return std::make_unique<clang::MultiplexConsumer>(std::move(in_order));
  }

  bool ParseArgs(const clang::CompilerInstance& /*compiler*/,
                 const std::vector<std::string>& /*words*/) override {
    return true;
  }

  /// Runs wherever the plug-in is loaded.
  ActionType getActionType() override { return AddAfterMainAction; }
};

const clang::FrontendPluginRegistry::Add<Action> kAction("icome-names",
                                                         "Runs the checks of .clang-tidy while compiling.");

}  // namespace

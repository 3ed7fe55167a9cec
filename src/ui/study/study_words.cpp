#include "ui/study/study_words.h"

#include <array>
#include <iterator>

namespace icome::ui {
namespace {

constexpr std::size_t kLanguageCount = std::size(kStudyLanguages);
using StudyWordRow = std::array<const char*, kLanguageCount>;

// A row for each enumerator and in it a text for each language, in the orders of their declarations.
constexpr StudyWordRow kStudyWordTable[] = {
    {"Go on", "Verder", "Weiter", "Continuer"},
    {"I agree", "Ik stem toe", "Ich bin einverstanden", "J\u2019accepte"},
    {"I do not agree", "Ik stem niet toe", "Ich bin nicht einverstanden", "Je n\u2019accepte pas"},
    {"You do not take part", "U neemt niet deel", "Sie nehmen nicht teil", "Vous ne participez pas"},
    {"That is perfectly all right, and you need not say why. Thank you for your time.",
     "Dat is helemaal in orde, en u hoeft niet te zeggen waarom. Dank u voor uw tijd.",
     "Das ist völlig in Ordnung, und Sie müssen nicht sagen, warum. Vielen Dank für Ihre Zeit.",
     "C\u2019est tout à fait permis, et vous n\u2019avez pas à dire pourquoi. Merci pour votre temps."},
    {"Part %1 of %2", "Deel %1 van %2", "Teil %1 von %2", "Partie %1 sur %2"},
    {"The trials begin", "De beurten beginnen", "Die Durchgänge beginnen", "Les essais commencent"},
    {"Go on when you are ready.", "Ga verder wanneer u klaar bent.",
     "Machen Sie weiter, wenn Sie bereit sind.", "Continuez quand vous êtes prêt."},
    {"You practise first. Go on when you are ready.", "U oefent eerst. Ga verder wanneer u klaar bent.",
     "Zuerst üben Sie. Machen Sie weiter, wenn Sie bereit sind.",
     "Vous vous entraînez d\u2019abord. Continuez quand vous êtes prêt."},
    {"Practice is over", "Het oefenen is voorbij", "Die Übung ist vorbei", "L\u2019entraînement est terminé"},
    {"From now on it is measured. Go on when you are ready.",
     "Vanaf nu wordt er gemeten. Ga verder wanneer u klaar bent.",
     "Ab jetzt wird gemessen. Machen Sie weiter, wenn Sie bereit sind.",
     "À partir de maintenant, les essais sont mesurés. Continuez quand vous êtes prêt."},
    {"Take a break", "Neem even pauze", "Machen Sie eine Pause", "Faites une pause"},
    {"Let your hand and your eyes rest.", "Laat uw hand en uw ogen rusten.",
     "Lassen Sie Hand und Augen ruhen.", "Reposez votre main et vos yeux."},
    {"You can go on in %1", "U kunt verder over %1", "Es geht weiter in %1",
     "Vous pourrez continuer dans %1"},
    {"One moment\u2026", "Een ogenblik\u2026", "Einen Moment\u2026", "Un instant\u2026"},
    {"Bring the pointer to the ball", "Breng de aanwijzer naar de bol", "Führen Sie den Zeiger zur Kugel",
     "Amenez le pointeur sur la boule"},
    {"Hold still: %1 s", "Houd stil: %1 s", "Halten Sie still: %1 s", "Ne bougez plus : %1 s"},
    {"Go!", "Start!", "Los!", "Partez !"},
    {"Mouse: move \u00b7 wheel: away, nearer", "Muis: bewegen \u00b7 wiel: weg, dichter",
     "Maus: bewegen \u00b7 Rad: weg, näher", "Souris : bouger \u00b7 molette : loin, près"},
    {"Trial %1 of %2", "Beurt %1 van %2", "Durchgang %1 von %2", "Essai %1 sur %2"},
    {"Practice: trial %1 of %2", "Oefenen: beurt %1 van %2", "Übung: Durchgang %1 von %2",
     "Entraînement : essai %1 sur %2"},
    {"Practice: trial %1", "Oefenen: beurt %1", "Übung: Durchgang %1", "Entraînement : essai %1"},
    {"* needs an answer", "* vraagt een antwoord", "* braucht eine Antwort", "* demande une réponse"},
    {"You may choose several.", "U mag er meer dan één kiezen.", "Sie können mehrere wählen.",
     "Vous pouvez en choisir plusieurs."},
    {"Please answer this question.", "Gelieve deze vraag te beantwoorden.",
     "Bitte beantworten Sie diese Frage.", "Veuillez répondre à cette question."},
    {"Please give a number.", "Gelieve een getal te geven.", "Bitte geben Sie eine Zahl an.",
     "Veuillez donner un nombre."},
    {"Please give a number from %1 to %2.", "Gelieve een getal van %1 tot %2 te geven.",
     "Bitte geben Sie eine Zahl von %1 bis %2 an.", "Veuillez donner un nombre de %1 à %2."},
    {"Please give a number of at least %1.", "Gelieve een getal van minstens %1 te geven.",
     "Bitte geben Sie eine Zahl von mindestens %1 an.", "Veuillez donner un nombre d\u2019au moins %1."},
    {"Please give a number of at most %1.", "Gelieve een getal van hoogstens %1 te geven.",
     "Bitte geben Sie eine Zahl von höchstens %1 an.", "Veuillez donner un nombre d\u2019au plus %1."},
    {"Enter: go on   \u00b7   Esc: interrupt", "Enter: verder   \u00b7   Esc: onderbreken",
     "Eingabe: weiter   \u00b7   Esc: unterbrechen", "Entrée : continuer   \u00b7   Échap : interrompre"},
    {"1\u20139: choose   \u00b7   Tab: next field   \u00b7   Enter, or Ctrl+Enter in a text: go on",
     "1\u20139: kiezen   \u00b7   Tab: volgend veld   \u00b7   Enter, of Ctrl+Enter in een tekst: verder",
     "1\u20139: wählen   \u00b7   Tab: nächstes Feld   \u00b7   Eingabe, im Text Strg+Eingabe: weiter",
     "1\u20139 : choisir   \u00b7   Tab : champ suivant   \u00b7   Entrée, ou Ctrl+Entrée dans un texte : "
     "continuer"},
    {"Interrupt the study?", "De studie onderbreken?", "Die Studie unterbrechen?",
     "Interrompre l\u2019étude ?"},
    {"Your answers and trials so far are kept. A trial under way, and a page that is not finished, begin "
     "again.",
     "Uw antwoorden en beurten tot nu toe blijven bewaard. Een beurt die bezig is, en een pagina die niet af "
     "is, begint opnieuw.",
     "Ihre Antworten und Durchgänge bis hierher bleiben erhalten. Ein laufender Durchgang und eine Seite, "
     "die "
     "nicht fertig ist, beginnen von vorn.",
     "Vos réponses et essais jusqu\u2019ici sont conservés. Un essai en cours, ou une page non terminée, "
     "recommence."},
    {"Go on with the study", "Verdergaan met de studie", "Mit der Studie weitermachen",
     "Continuer l\u2019étude"},
    {"Interrupt", "Onderbreken", "Unterbrechen", "Interrompre"},
    {"Something went wrong", "Er ging iets mis", "Etwas ist schiefgegangen", "Un problème est survenu"},
    {"It is not your fault, and what you did before is kept. Please call the person who leads the study.",
     "Het ligt niet aan u, en wat u eerder deed blijft bewaard. Roep de persoon die de studie leidt.",
     "Es liegt nicht an Ihnen, und was Sie vorher getan haben, bleibt erhalten. Bitte rufen Sie die Person, "
     "die die Studie leitet.",
     "Ce n\u2019est pas votre faute, et ce que vous avez déjà fait est conservé. Veuillez appeler la "
     "personne "
     "qui mène l\u2019étude."},
    {"Try again", "Opnieuw proberen", "Erneut versuchen", "Réessayer"},
    {"End here (can be resumed)", "Hier stoppen (kan hervat worden)",
     "Hier beenden (kann fortgesetzt werden)", "Arrêter ici (peut être repris)"},
    {"Thank you", "Dank u wel", "Vielen Dank", "Merci"},
    {"You have done everything, and all of it has been kept. Please tell the person who leads the study.",
     "U hebt alles gedaan, en alles is bewaard. Laat het weten aan de persoon die de studie leidt.",
     "Sie haben alles erledigt, und alles ist gespeichert. Bitte sagen Sie der Person Bescheid, die die "
     "Studie leitet.",
     "Vous avez tout fait, et tout a été conservé. Veuillez prévenir la personne qui mène l\u2019étude."},
    {"Close", "Sluiten", "Schließen", "Fermer"},
};
static_assert(std::size(kStudyWordTable) == kStudyWordCount);

}  // namespace

StudyWords::StudyWords(std::string_view language) {
  const std::string_view its = language.substr(0, language.find_first_of("-_"));
  for (std::size_t column = 0; column < kLanguageCount; ++column) {
    if (kStudyLanguages[column] == its) column_ = column;
  }
}

QString StudyWords::operator()(StudyWord word) const {
  return QString::fromUtf8(kStudyWordTable[std::size_t(word)][column_]);
}

QString study_text(const study::Text& text, std::size_t language) {
  return language < text.size() ? QString::fromStdString(text[language]) : QString();
}

}  // namespace icome::ui

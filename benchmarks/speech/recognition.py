#!/usr/bin/env python3
"""How often icome listen hears what was said, and how long it takes.

  python3 benchmarks/speech/recognition.py build/release/bin/icome [--sentences 60] [--wrong]

The sentences that it should understand are those of tests/speech/dialogue/dialogues.txt, spoken by voices of espeak-ng (package espeak-ng) about
a design with a few things; others, which it should not take for any, are below.
Synthetic voices are not people: the figures compare settings of the recogniser, and say little of how it hears you.
"""

import argparse
import json
import pathlib
import random
import re
import subprocess
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
THINGS = ["a red box", "a blue box on it", "a small green sphere left of the red box", "a large wooden sphere", "a blue cone",
          "a small red cone", "a yellow cone", "two small blue cylinders", "name it leg", "a rubber ball", "name it seat"]
OTHERS = """
make me a coffee please / what time is the train to london / the weather is nice today / i think we should go home now /
did you see the game last night / can you pass me the salt / my brother lives in new york / she bought a new car yesterday /
where did i put my keys / let us have lunch at noon / the meeting starts at three / please call your mother /
he does not like the music / turn on the radio / how are you doing / it is raining again / have you read this paper /
the printer is out of paper / good morning everybody / nobody knows the answer / play some jazz /
open the window it is hot / remember to buy milk / the dog is barking at the cat / thank you very much /
who was that on the phone / let me think about it / this is really difficult / i will be back in a minute"""
VOICES = ["en-us", "en-us+f3", "en-gb", "en-us+m7"]


def answers(program, command, *arguments):
    """The answers of a command of speech, by a person without words of their own."""
    done = subprocess.run([program, command, "--json", "--words", "no such file.toml", *arguments],
                          capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def sentences(program, design):
    """Sentences of two words or more that the design's grammar has words for, in an order of their own."""
    said = []
    for line in (PROJECT / "tests/speech/dialogue/dialogues.txt").read_text().splitlines():
        words = line[2:].strip()
        if line.startswith("> ") and re.fullmatch(r"[a-z ']+", words) and " " in words:
            said.append(words)
    known = [sentence for sentence in dict.fromkeys(said) if "I do not" not in answers(program, "say", "--design", design, sentence)[0]["reply"]]
    random.Random(5).shuffle(known)
    return known


def recognised(program, design, folder, voice, said):
    """What icome listen answers to each sentence in that voice."""
    files = []
    for i, sentence in enumerate(said):
        files.append(f"{folder}/{i:03}.wav")
        subprocess.run(["espeak-ng", "-v", voice, "-w", files[-1], sentence], check=True)
    heard = {file: [] for file in files}
    for answer in answers(program, "listen", "--design", design, *files):
        heard[answer["file"]].append(answer)
    return list(heard.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sentences", type=int, default=60)
    parser.add_argument("--wrong", action="store_true", help="print what is misheard")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        design = f"{folder}/design.wrl"
        answers(options.program, "say", *THINGS, "--out", design)
        chosen = sentences(options.program, design)[: options.sentences]
        others = [" ".join(sentence.split()) for sentence in OTHERS.split("/")]
        print(f"{'voice':12}{'right':>12}{'ms, median':>12}{'p95':>8}{'others taken':>16}")
        for voice in VOICES:
            heard = recognised(options.program, design, folder, voice, chosen)
            understood = [" ".join(it["heard"] for it in answers) for answers in heard]
            right = sum(said == words for said, words in zip(chosen, understood))
            if options.wrong:
                print("\n".join(f"  {said} -> {words}" for said, words in zip(chosen, understood) if said != words))
            times = sorted(it["ms"] for answers in heard for it in answers)
            taken = sum(any(it["accepted"] for it in answers)
                        for answers in recognised(options.program, design, folder, voice, others))
            print(f"{voice:12}{right:>5} of {len(chosen):<4}{times[len(times) // 2]:>11.0f}"
                  f"{times[int(0.95 * (len(times) - 1))]:>8.0f}{taken:>9} of {len(others)}", flush=True)


if __name__ == "__main__":
    main()

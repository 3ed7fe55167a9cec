#!/usr/bin/env python3
"""How often icome listen hears what was said, and how long it takes.

  python3 benchmarks/speech/recognition.py build/release/bin/icome [--sentences 60] [--wrong]

The sentences are those of tests/speech/dialogue/dialogues.txt, spoken by voices of espeak-ng (package espeak-ng).
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
VOICES = ["en-us", "en-us+f3", "en-gb", "en-us+m7"]


def answers(program, command, *arguments):
    """The answers of a command of speech, by a person without words of their own."""
    done = subprocess.run([program, command, "--json", "--words", "no such file.toml", *arguments],
                          capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def sentences(program):
    """Sentences of two words or more that an empty design's grammar has words for, in an order of their own."""
    said = []
    for line in (PROJECT / "tests/speech/dialogue/dialogues.txt").read_text().splitlines():
        words = line[2:].strip()
        if line.startswith("> ") and re.fullmatch(r"[a-z ']+", words) and " " in words:
            said.append(words)
    known = [sentence for sentence in dict.fromkeys(said) if "I do not" not in answers(program, "say", sentence)[0]["reply"]]
    random.Random(5).shuffle(known)
    return known


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sentences", type=int, default=60)
    parser.add_argument("--wrong", action="store_true", help="print what is misheard")
    options = parser.parse_args()
    chosen = sentences(options.program)[: options.sentences]
    print(f"{'voice':12}{'right':>12}{'ms, median':>12}{'p95':>8}")
    with tempfile.TemporaryDirectory() as folder:
        for voice in VOICES:
            files = []
            for i, sentence in enumerate(chosen):
                files.append(f"{folder}/{i:03}.wav")
                subprocess.run(["espeak-ng", "-v", voice, "-w", files[-1], sentence], check=True)
            heard = {}
            for answer in answers(options.program, "listen", *files):
                heard.setdefault(answer["file"], []).append(answer)
            pairs = [(sentence, " ".join(it["heard"] for it in heard.get(file, [])))
                     for file, sentence in zip(files, chosen)]
            right = sum(sentence == understood for sentence, understood in pairs)
            if options.wrong:
                print("\n".join(f"  {said} -> {understood}" for said, understood in pairs if said != understood))
            times = sorted(it["ms"] for all_heard in heard.values() for it in all_heard)
            print(f"{voice:12}{right:>5} of {len(chosen):<4}{times[len(times) // 2]:>11.0f}"
                  f"{times[int(0.95 * (len(times) - 1))]:>8.0f}", flush=True)


if __name__ == "__main__":
    main()

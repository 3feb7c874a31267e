# `make check` and `make test` need Python 3.11 or newer, git and make, and nothing else.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
JOBS ?= 2
# Slow tests wait for a third of their time: for processes of their own, and for time limits that these shall pass.
SLOW_JOBS ?= 3

.PHONY: check test test-slow test-proofs test-sweeps test-all lint docs engines notebooks models kernels architecture clean

check: $(VENV)/.check  ## run the catalogue against every engine; writes furiko-report/
	$(BIN)/furiko check

test: $(VENV)/.test  ## run the tests, less the slow ones: some minutes
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m "not slow"

test-slow: $(VENV)/.test  ## run the slow tests alone, less proofs and sweeps
	$(BIN)/python -m pytest -n $(SLOW_JOBS) --dist worksteal -m "slow and not proof and not sweep"

test-proofs: $(VENV)/.test  ## prove what the collections of derivations say, which is to be done when one has changed
	$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m proof

test-sweeps: $(VENV)/.test  ## scores, campaigns and proofs over the whole of what the other tests take samples of; before a release
	$(BIN)/python -m pytest -n $(SLOW_JOBS) --dist worksteal -m sweep

test-all: test test-slow test-proofs test-sweeps  ## run every test

lint: $(VENV)/.test  ## ruff, mypy --strict and basedpyright
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/basedpyright

docs: $(VENV)/.docs  ## build the documentation into build/docs/; a warning fails, and nothing is fetched
	$(BIN)/python -m sphinx -W --keep-going --quiet -b html docs build/docs
	@echo build/docs/index.html

notebooks: $(VENV)/.check  ## run the notebooks in docs/notebooks/, and keep what they print
	$(BIN)/python docs/notebooks.py

ENGINES ?= mujoco pin exudyn dart drake pybullet sympy

engines:  ## measure all engines on the whole catalogue, and write docs/engines.md; PROBE=PYTHON looks there for defects
	-$(BIN)/furiko check --profile quick --no-cache $(addprefix -e ,$(ENGINES)) --out build/engines
	$(BIN)/furiko engines --table build/engines $(addprefix --probe ,$(PROBE)) --out docs/engines.md

models:  ## write the catalogue's model files and the JSON schemas again
	$(BIN)/python -m furiko.models.writers.catalogue_files
	$(BIN)/python -m furiko.records.schema

kernels: $(VENV)/.check  ## write the compiled kernels ahead again, once their text has changed
	$(BIN)/python -m furiko.reference.write_kernels

architecture:  ## draw the picture of the rooms in docs/architecture.md again
	$(BIN)/python tests/package_rooms.py

clean:
	rm -rf $(VENV) build dist furiko.egg-info

$(VENV)/.check: pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; v = sys.version_info; sys.exit(v < (3, 11) and "furiko needs Python 3.11 or newer; this is %d.%d: make PYTHON=python3.12" % v[:2])'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --constraint constraints.txt --editable '.[all]'
	@touch $@

$(VENV)/.docs: $(VENV)/.check
	$(BIN)/pip install --quiet --constraint constraints.txt --editable '.[docs]'
	@touch $@

$(VENV)/.test: $(VENV)/.check
	$(BIN)/pip install --quiet --constraint constraints.txt --editable '.[dev]'
	@touch $@

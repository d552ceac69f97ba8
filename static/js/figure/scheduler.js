/**
 * Latest wins: one job runs, the newest one waits, everything between is dropped.
 * There is never a queue, so a slow frame delays the next by at most its own length.
 *
 * @template Job
 */
export class LatestWins {
  /** @type {Job | null} */
  #waiting = null;
  #busy = false;

  /** @param {(job: Job) => Promise<void>} run Deals with its own failures. */
  constructor(run) {
    this.run = run;
  }

  /** Whether a newer job is waiting than the one that runs. */
  get stale() {
    return this.#waiting !== null;
  }

  /** Whether nothing runs or waits. */
  get idle() {
    return !this.#busy;
  }

  /** @param {Job} job */
  submit(job) {
    this.#waiting = job;
    if (!this.#busy) this.#drain();
  }

  /** Forget what waits. */
  clear() {
    this.#waiting = null;
  }

  async #drain() {
    this.#busy = true;
    try {
      while (this.#waiting !== null) {
        const job = this.#waiting;
        this.#waiting = null;
        await this.run(job);
      }
    } finally {
      this.#busy = false;
    }
  }
}

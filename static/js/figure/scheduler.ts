/**
 * Latest wins: one job runs, the newest one waits, everything between is dropped.
 * There is never a queue, so a slow frame delays the next by at most its own length.
 */
export class LatestWins<Job> {
  #waiting: Job | null = null;
  #busy = false;

  /** @param run Deals with its own failures. */
  constructor(readonly run: (job: Job) => Promise<void>) {}

  /** Whether a newer job is waiting than the one that runs. */
  get stale() {
    return this.#waiting !== null;
  }

  /** Whether nothing runs or waits. */
  get idle() {
    return !this.#busy;
  }

  submit(job: Job) {
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

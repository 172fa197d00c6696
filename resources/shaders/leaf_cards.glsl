// Which cluster a leaf belongs to, and how far that is drawn as a card.
layout(std430, binding = 9) readonly buffer LeafCards { uint leafCards[]; };
#ifdef COUNT
layout(std430, binding = 10) buffer CardStates { uvec2 cardStates[]; };  // fade, area of the leaves there in mm2
#else
layout(std430, binding = 10) readonly buffer CardStates { uvec2 cardStates[]; };
#endif
layout(location = 4) uniform uint cardsOn;

const uint kNoCard = 0xffffffffu;

// 0: the leaf is drawn; 1: its cluster's card stands for it.
float cardFade(uint leaf, uint state) {
  if (cardsOn == 0u || state != kAttached) return 0.0;
  uint card = leafCards[leaf];
  return card == kNoCard ? 0.0 : uintBitsToFloat(cardStates[card].x);
}
